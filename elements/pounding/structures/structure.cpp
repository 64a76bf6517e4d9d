#include <pounding/structures/structure.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <pounding/structures/damping.hpp>

namespace pounding {

YieldingPart::YieldingPart(std::string part, Row factors, std::string law_name, std::vector<Parameter> numbers,
                           std::shared_ptr<const Element> by_element, int of_direction)
    : name(std::move(part)),
      deformation(std::move(factors)),
      law(std::move(law_name)),
      parameters(std::move(numbers)),
      element(std::move(by_element)),
      direction(of_direction) {
  if (has_spring())
    limits = YieldLimits(spring());
  else
    limits.positive = limits.negative = yield_deformation();
}

Eigen::Vector3d outward(Side side) {
  switch (side) {
    case Side::plus_x: return Eigen::Vector3d::UnitX();
    case Side::minus_x: return -Eigen::Vector3d::UnitX();
    case Side::plus_y: return Eigen::Vector3d::UnitY();
    default: return -Eigen::Vector3d::UnitY();
  }
}

Side opposite(Side side) {
  switch (side) {
    case Side::plus_x: return Side::minus_x;
    case Side::minus_x: return Side::plus_x;
    case Side::plus_y: return Side::minus_y;
    default: return Side::plus_y;
  }
}

Side side_of(const Eigen::Vector3d& direction) {
  if (std::abs(direction.x()) >= std::abs(direction.y())) return direction.x() >= 0 ? Side::plus_x : Side::minus_x;
  return direction.y() >= 0 ? Side::plus_y : Side::minus_y;
}

ContactPoint Surface::column(double, Side, double) const {
  throw std::invalid_argument("this structure has no columns for contact between floors; name a floor");
}

ContactPoint Surface::node(const std::string&) const {
  throw std::invalid_argument("this structure has no nodes; name a floor");
}

Row Surface::displacement(const std::string&, const std::string&) const {
  throw std::invalid_argument("this structure has no nodes; name a floor");
}

SparseMatrix Structure::formed_damping() const {
  const SparseMatrix own = by_mass * mass + by_stiffness * stiffness + damping;
  return modal_damping.size() > 0 ? SparseMatrix(own + modal_damping) : own;
}

SparseMatrix Structure::whole_damping() const {
  const SparseMatrix formed = formed_damping();
  return modal_ratio > 0 && modal_damping.size() == 0
             ? SparseMatrix(formed + modal_damping_matrix(mass, stiffness, modal_ratio))
             : formed;
}

Eigen::Vector3d Structure::total_mass() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j < 3; ++j)
    for (const Support& support : supports)
      for (const Support& other : supports) sum[j] += support.influence.col(j).dot(other.load.col(j));
  return sum;
}

double YieldingPart::parameter(std::string_view parameter_name) const {
  const auto found = std::ranges::find(parameters, parameter_name, &Parameter::name);
  return found == parameters.end() ? std::numeric_limits<double>::quiet_NaN() : found->value;
}

std::size_t Structure::members_that_yield() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(yielding, [](const YieldingPart& part) { return !part.is_device(); }));
}

}  // namespace pounding
