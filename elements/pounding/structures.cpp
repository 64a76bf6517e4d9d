#include <pounding/structures.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

#include <pounding/bilinear_spring.hpp>

namespace pounding {
namespace {

void require_positive(double value, const char* what) {
  if (!(value > 0) || std::isinf(value)) throw std::invalid_argument(std::string(what) + " must be positive and finite");
}

void label_floors(Structure& structure) {
  for (int i = 0; i < structure.size(); ++i) structure.floors.push_back(std::to_string(i + 1));
  structure.initial_displacement = structure.initial_velocity = Eigen::VectorXd::Zero(structure.size());
}

}  // namespace

Structure make_body(double mass) {
  require_positive(mass, "mass");
  Structure s;
  s.kind = "body";
  s.mass = Eigen::MatrixXd::Constant(1, 1, mass);
  s.damping = s.stiffness = Eigen::MatrixXd::Zero(1, 1);
  s.damping_note = "none";
  label_floors(s);
  return s;
}

Structure make_oscillator(double mass, double stiffness, double damping_ratio) {
  require_positive(mass, "mass");
  require_positive(stiffness, "stiffness");
  if (!(damping_ratio >= 0)) throw std::invalid_argument("damping must not be negative");
  Structure s;
  s.kind = "oscillator";
  s.mass = Eigen::MatrixXd::Constant(1, 1, mass);
  s.stiffness = Eigen::MatrixXd::Constant(1, 1, stiffness);
  s.damping = Eigen::MatrixXd::Constant(1, 1, 2 * damping_ratio * std::sqrt(stiffness * mass));
  s.storey_stiffness = {stiffness};
  label_floors(s);
  return s;
}

Structure make_shear_building(const std::vector<double>& masses, const std::vector<double>& stiffnesses,
                              const std::vector<double>& heights) {
  const int n = static_cast<int>(masses.size());
  if (n == 0 || stiffnesses.size() != masses.size()) throw std::invalid_argument("one mass and one stiffness a storey");
  Structure s;
  s.kind = "shear_building";
  s.mass = s.damping = s.stiffness = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    require_positive(masses[i], "mass");
    require_positive(stiffnesses[i], "stiffness");
    s.mass(i, i) = masses[i];
    s.stiffness(i, i) += stiffnesses[i];
    if (i == 0) continue;
    s.stiffness(i - 1, i - 1) += stiffnesses[i];
    s.stiffness(i - 1, i) = s.stiffness(i, i - 1) = -stiffnesses[i];
  }
  s.storey_stiffness = stiffnesses;
  s.heights = heights;
  label_floors(s);
  return s;
}

void let_storeys_yield(Structure& s, const std::vector<double>& yield_forces, const std::vector<double>& hardening) {
  const std::size_t storeys = s.storey_stiffness.size();
  if (yield_forces.size() != storeys || hardening.size() != storeys)
    throw std::invalid_argument("one yield force and one hardening a storey");
  s.yielding.clear();
  for (std::size_t i = 0; i < storeys; ++i)
    s.yielding.emplace_back(yield_forces[i], hardening[i],
                            std::make_unique<BilinearSpring>(BilinearSpring::Parameters{
                                .stiffness = s.storey_stiffness[i], .yield_force = yield_forces[i], .hardening = hardening[i]}));
}

Structure make_wall() {
  Structure s;
  s.kind = "wall";
  s.damping_note = "rigid";
  label_floors(s);
  return s;
}

}  // namespace pounding
