#pragma once
/// PETSc's and SLEPc's start and end, their errors as exceptions, and the owner of their objects. The only headers that know
/// them are in this folder.

#include <petscts.h>

#include <string>
#include <utility>
#include <vector>

#include <pounding/core/error.hpp>

namespace pounding::petsc {

/// Starts PETSc (with MPI) and SLEPc unless the host program has done so, each by itself, and ends only what it started. A
/// host that owns PETSc ends it after this.
class Environment {
 public:
  /// `options`: words of a command line, as PETSc reads them ("-pounding_ts_rtol", "1e-6").
  explicit Environment(const std::vector<std::string>& options = {});
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  /// Options with the prefix `-pounding_` that nothing has read.
  static std::vector<std::string> unread_options();
  /// Options with the prefix `-pounding_` and their values as PETSc has them now, sorted: "-pounding_ts_rtol 1e-6".
  static std::vector<std::string> given_options();

 private:
  bool owns_petsc_ = false, owns_slepc_ = false;
};

/// Throws SolverError with PETSc's own text when `code` is not zero.
void check(PetscErrorCode code);

/// For callbacks: the code to return, after which check() throws this text alone.
PetscErrorCode fail(const std::string& text);

/// How PETSc destroys an object of this type; specialised beside what uses it.
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

/// Owns one PETSc object.
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

  /// The object, still owned here; null when there is none.
  T get() const { return object_; }
  operator T() const { return object_; }
  /// For PETSc's creating functions; what was owned is destroyed.
  T* out() {
    reset();
    return &object_;
  }

 private:
  void reset() {
    if (object_) Destroyer<T>::destroy(&object_);
    object_ = nullptr;
  }
  T object_ = nullptr;
};

}  // namespace pounding::petsc
