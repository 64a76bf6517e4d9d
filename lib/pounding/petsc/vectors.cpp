#include <pounding/petsc/vectors.hpp>

#include <algorithm>
#include <vector>

#include <pounding/petsc/version.hpp>

namespace pounding::petsc {

PetscErrorCode gather(Vec from, Eigen::VectorXd& to) {
  const PetscScalar* values = nullptr;
  const PetscInt* ranges = nullptr;
  PetscMPIInt processes = 0;
  PetscFunctionBegin;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(from));
  PetscCallMPI(MPI_Comm_size(comm, &processes));
  PetscCall(VecGetOwnershipRanges(from, &ranges));
  std::vector<PetscMPIInt> counts(processes), first(processes);
  for (int p = 0; p < processes; ++p) {
    first[p] = static_cast<PetscMPIInt>(ranges[p]);
    counts[p] = static_cast<PetscMPIInt>(ranges[p + 1] - ranges[p]);
  }
  PetscInt own = 0;
  PetscCall(VecGetLocalSize(from, &own));
  PetscCall(VecGetArrayRead(from, &values));
  PetscCallMPI(MPI_Allgatherv(values, static_cast<PetscMPIInt>(own), MPIU_SCALAR, to.data(), counts.data(),
                              first.data(), MPIU_SCALAR, comm));
  PetscCall(VecRestoreArrayRead(from, &values));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode scatter(const Eigen::VectorXd& from, Vec to) {
  PetscScalar* values = nullptr;
  PetscFunctionBegin;
  PetscInt first = 0, end = 0;
  PetscCall(VecGetOwnershipRange(to, &first, &end));
  PetscCall(VecGetArrayWrite(to, &values));
  std::copy_n(from.data() + first, end - first, values);
  PetscCall(VecRestoreArrayWrite(to, &values));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

}  // namespace pounding::petsc
