// The installed library in a program that owns MPI and PETSc: each process runs its own model on its own communicator.
#include <petscts.h>

#include <cmath>
#include <cstdio>

#include <pounding/elements.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/run/run.hpp>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  MPI_Comm own;
  MPI_Comm_split(MPI_COMM_WORLD, rank, 0, &own);
  MPI_Comm_size(own, &size);
  const double requested = rank == 0 ? 0.65 : 0.5;
  double restitution = 0;
  {
    const pounding::petsc::Environment environment;
    pounding::Model model;
    const auto ball = model.add("ball", pounding::make_body({.mass = 60e3}), {.initial_velocity = 1});
    const auto wall = model.add("wall", pounding::make_wall());
    model.link(ball, wall, {.gap = 0.01}, pounding::laws::Jankowski{.stiffness = 2.75e9, .restitution = requested});
    model.analysis.duration = 0.2;
    restitution = pounding::run(model, {.comm = own}).results.impacts.at(0).restitution;
  }
  std::printf("restitution %.5f\n", restitution);
  MPI_Comm_free(&own);
  if (PetscFinalize() != 0) return 1;
  MPI_Finalize();
  return size == 1 && std::abs(restitution - requested) < 1e-4 ? 0 : 1;
}
