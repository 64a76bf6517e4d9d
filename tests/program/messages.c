/* Kills a process of a run at its n-th message, loaded by LD_PRELOAD into every process of mpirun. Counted are the
   calls of MPI in which processes wait for each other, from main on, of the program and of PETSc.

   POUNDING_FAULT_RANK     the process that is killed
   POUNDING_FAULT_AT       the number of its call, from 1; 0 for none
   POUNDING_FAULT_SIGNAL   the signal that it raises there
   POUNDING_FAULT_COUNT    file to which the number of calls of that process is written at the end */
#include <mpi.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

static long calls = 0;

static long setting(const char* name) {
  const char* value = getenv(name);
  return value ? atol(value) : -1;
}

static int is_chosen(void) {
  static int chosen = -1;
  if (chosen < 0) chosen = setting("OMPI_COMM_WORLD_RANK") == setting("POUNDING_FAULT_RANK");
  return chosen;
}

static void message(void) {
  if (is_chosen() && ++calls == setting("POUNDING_FAULT_AT")) raise((int)setting("POUNDING_FAULT_SIGNAL"));
}

__attribute__((destructor)) static void at_the_end(void) {
  const char* path = getenv("POUNDING_FAULT_COUNT");
  FILE* file = is_chosen() && path ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", calls);
  fclose(file);
}

#define CALL(name, parameters, arguments) \
  int MPI_##name parameters {             \
    message();                            \
    return PMPI_##name arguments;         \
  }

CALL(Allreduce, (const void* from, void* to, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm),
     (from, to, count, type, op, comm))
CALL(Allgather,
     (const void* from, int count, MPI_Datatype type, void* to, int counts, MPI_Datatype types, MPI_Comm comm),
     (from, count, type, to, counts, types, comm))
CALL(Allgatherv,
     (const void* from, int count, MPI_Datatype type, void* to, const int counts[], const int first[],
      MPI_Datatype types, MPI_Comm comm),
     (from, count, type, to, counts, first, types, comm))
CALL(Bcast, (void* data, int count, MPI_Datatype type, int root, MPI_Comm comm), (data, count, type, root, comm))
CALL(Barrier, (MPI_Comm comm), (comm))
CALL(Ibarrier, (MPI_Comm comm, MPI_Request* request), (comm, request))
CALL(Comm_dup, (MPI_Comm comm, MPI_Comm* copy), (comm, copy))
CALL(Send, (const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm),
     (data, count, type, to, tag, comm))
CALL(Recv, (void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status),
     (data, count, type, from, tag, comm, status))
CALL(Isend, (const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request),
     (data, count, type, to, tag, comm, request))
CALL(Irecv, (void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request),
     (data, count, type, from, tag, comm, request))
CALL(Finalize, (void), ())
