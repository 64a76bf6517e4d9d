"""Recipe for Spack 1.0 and later, of the packages that cmake/install-debian.sh names. Not run, since Spack was not
available. Names of packages and variants are those of spack-packages of July 2026.

    spack repo create ~/recipes pounding_recipes
    mkdir -p ~/recipes/spack_repo/pounding_recipes/packages/pounding
    cp cmake/cluster/package.py ~/recipes/spack_repo/pounding_recipes/packages/pounding/
    spack repo add ~/recipes/spack_repo/pounding_recipes
    spack dev-build pounding@0.3.0
"""

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import depends_on, license, variant, version


class Pounding(CMakePackage):
    """Adjacent structures that hit each other in earthquakes."""

    license("BSD-3-Clause")
    version("0.3.0")
    variant("mpi", default=True, description="Several processes for one model")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("petsc@3.18: +suite-sparse~complex~int64")
    depends_on("petsc +mpi+mumps", when="+mpi")
    depends_on("petsc ~mpi~hypre~superlu-dist~hdf5", when="~mpi")
    depends_on("slepc@3.18:")
    depends_on("hdf5 +mpi", when="+mpi")
    depends_on("hdf5 ~mpi", when="~mpi")
    depends_on("mpi", when="+mpi")
    depends_on("eigen@3.4:3.4.99")
    depends_on("yaml-cpp")
    depends_on("cli11")
    depends_on("fmt")
    depends_on("nlohmann-json")
    depends_on("zlib-api")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("POUNDING_BUILD_TESTS", False),
            self.define("POUNDING_PYTHON", False),
            self.define_from_variant("POUNDING_MPI", "mpi"),
            self.define("MPI_HDF5_MODULE", "hdf5"),
        ]
