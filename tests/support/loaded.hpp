#pragma once
/// A spring in isolation, with its memory.

#include <memory>
#include <optional>
#include <utility>

#include <pounding/structures/spring.hpp>

namespace pounding::test {

/// The functions of a spring S with parameters P, which it owns together with its memory. Copies are independent.
template <class S, class P = int>
class Loaded : public LoadedSpring {
 public:
  explicit Loaded(std::shared_ptr<const S> spring) : LoadedSpring(*spring), own_(std::move(spring)) {}
  explicit Loaded(const P& parameters) : Loaded(std::make_shared<const S>(parameters)) {}

  Loaded* operator->() noexcept { return this; }
  const Loaded* operator->() const noexcept { return this; }
  const S& own() const noexcept { return *own_; }
  double stiffness() const noexcept { return spring().stiffness(); }
  double first_slope() const noexcept { return spring().first_slope(); }
  double yield_deformation() const noexcept { return spring().yield_deformation(); }
  bool slips() const noexcept { return spring().slips(); }
  double first_slip(const LinkMotion& motion) const noexcept { return spring().first_slip(motion); }
  std::optional<double> bend(const Quintic& path, double near) const noexcept {
    return spring().bend(memory(), path, near);
  }
  double lost() const noexcept { return energy().lost; }
  double damped() const noexcept { return energy().damped; }
  double stored_correction() const noexcept { return energy().stored_correction; }

 private:
  std::shared_ptr<const S> own_;
};

}  // namespace pounding::test
