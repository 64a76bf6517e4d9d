#pragma once
/// A spring that hides its elastic range, so that a run takes the slow path at every step.

#include <memory>
#include <utility>

#include <pounding/structures/spring.hpp>

namespace pounding::test {

class WithoutRange final : public Spring {
 public:
  explicit WithoutRange(std::shared_ptr<const Element> spring)
      : own_(std::move(spring)), spring_(static_cast<const Spring&>(*own_)) {}
  /// `spring` must outlive it.
  explicit WithoutRange(const Spring& spring) : spring_(spring) {}

  using Spring::accept, Spring::evaluate, Spring::load, Spring::stiffness, Spring::start, Spring::yield_deformation;
  std::size_t memory_size() const noexcept override { return spring_.memory_size(); }
  void reset(ElementMemory memory) const noexcept override { spring_.reset(memory); }
  laws::Response evaluate(ConstElementMemory memory, const LinkMotion& motion) const noexcept override {
    return spring_.evaluate(memory, motion);
  }
  double stiffness() const noexcept override { return spring_.stiffness(); }
  double first_slope() const noexcept override { return spring_.first_slope(); }
  double yield_deformation() const noexcept override { return spring_.yield_deformation(); }
  std::optional<double> corner(ConstElementMemory memory, double deformation) const noexcept override {
    return spring_.corner(memory, deformation);
  }
  double slope_lost(ConstElementMemory memory, double deformation) const noexcept override {
    return spring_.slope_lost(memory, deformation);
  }
  bool has_corners() const noexcept override { return spring_.has_corners(); }
  void start(ElementMemory memory, const LinkMotion& motion) const override { spring_.start(memory, motion); }
  void accept(ElementMemory memory, const LinkStep& step) const override { spring_.accept(memory, step); }
  Instant inside(ConstElementMemory memory, const LinkStep& step, double s,
                 double deformation) const noexcept override {
    return spring_.inside(memory, step, s, deformation);
  }
  bool bends_sharply(const LinkStep& step) const noexcept override { return spring_.bends_sharply(step); }
  ElementEnergy energy(ConstElementMemory memory) const noexcept override { return spring_.energy(memory); }

 private:
  std::shared_ptr<const Element> own_;
  const Spring& spring_;
};

}  // namespace pounding::test
