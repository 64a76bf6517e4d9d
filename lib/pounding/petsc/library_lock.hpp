#pragma once
/// One lock for the libraries that are not thread-safe.

namespace pounding {

/// Lock of PETSc, SLEPc, MPI and HDF5: no other thread uses them during the lifetime of this object. A thread may take
/// it several times.
///
/// Options, error handlers, logs, communicators and identifiers of these libraries are global. Every function of this
/// library takes the lock for its calls of them. The callbacks of a run release it while they compute, so runs in
/// several threads proceed in parallel. A host that calls these libraries while other threads run models takes the lock
/// as well.
class LibraryLock {
 public:
  LibraryLock();
  ~LibraryLock();
  LibraryLock(const LibraryLock&) = delete;
  LibraryLock& operator=(const LibraryLock&) = delete;

  /// During its lifetime, this thread does not have the lock, however often it has taken it.
  class Released {
   public:
    Released();
    ~Released();
    Released(const Released&) = delete;
    Released& operator=(const Released&) = delete;

   private:
    int depth_;
  };
};

}  // namespace pounding
