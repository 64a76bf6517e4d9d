#pragma once
/// Owner of PETSc objects, the only place that destroys one.

#include <petscts.h>

#include <utility>

#include <pounding/petsc/library_lock.hpp>

namespace pounding::petsc {

/// Destroys a PETSc object of type T. Specialised here for types that several modules own, otherwise next to the single
/// owner.
template <class T>
struct Destroyer;
template <>
struct Destroyer<TS> {
  static PetscErrorCode destroy(TS* object) { return TSDestroy(object); }
};
template <>
struct Destroyer<Vec> {
  static PetscErrorCode destroy(Vec* object) { return VecDestroy(object); }
};

/// Owns one PETSc object; movable, not copyable.
template <class T>
class Handle {
 public:
  Handle() = default;
  ~Handle() { reset(); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      object_ = std::exchange(other.object_, nullptr);
    }
    return *this;
  }

  /// The object, still owned here; null if there is none.
  T get() const { return object_; }
  operator T() const { return object_; }
  /// Address for PETSc's creation functions; destroys the current object.
  T* out() {
    reset();
    return &object_;
  }

 private:
  void reset() {
    if (!object_) return;
    const LibraryLock lock;
    Destroyer<T>::destroy(&object_);
    object_ = nullptr;
  }
  T object_ = nullptr;
};

}  // namespace pounding::petsc
