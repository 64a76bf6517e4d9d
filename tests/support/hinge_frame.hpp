#pragma once
/// Plane frames with hinges at massless degrees of freedom, assembled without the library's frames.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include <pounding/links/contact.hpp>
#include <pounding/model/system.hpp>
#include <pounding/stepping/step_controller.hpp>
#include "support/bilinear_spring.hpp"
#include "support/dense.hpp"

namespace pounding::test {

/// Storeys of 3.2 m, one bay of 6 m, E 30 GPa, columns 0.4 x 0.4 m, beams 0.3 x 0.5 m, 20 t at every node in x and z,
/// no shear deformation. Springs of 10 x 6EI/L at the ends of beams (yield moment 180 kN m) and at feet (250 kN m),
/// hardening 0.003. Damping 5 % of the first mode, by mass. Degrees of freedom: x, z and rotation node by node, then
/// rotations of feet, then those of ends of beams.
struct HingeFrame {
  struct Options {
    int storeys = 3;
    double strength = 1;    ///< multiple of the yield moments
    bool elastic = false;   ///< stiffness without the springs
    int frames = 1;         ///< each a separate group, 20 m apart
    bool mirrored = false;  ///< the second frame moves in the opposite direction
  };

  Options options;
  System system;
  std::vector<std::unique_ptr<BilinearSpring>> springs;
  std::vector<std::unique_ptr<const Contact>> contacts;
  std::vector<double> spring_stiffness, yield_moment;
  Eigen::VectorXd base;        ///< base shear of the first frame: base . (K u + B F)
  int unknowns = 0;            ///< of one frame
  double first_frequency = 0;  ///< [rad/s]

  HingeFrame() : HingeFrame(Options{}, GroundMotion()) {}

  HingeFrame(const Options& given, const GroundMotion& ground) : options(given) {
    const int s = options.storeys, nodes = 2 * s;
    unknowns = 3 * nodes + 2 + 2 * s;
    const int n = unknowns * options.frames;
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n), m = k, b = Eigen::MatrixXd::Zero(n, 0);
    system.load = Eigen::MatrixXd::Zero(n, 1);
    base = Eigen::VectorXd::Zero(n);
    for (int f = 0; f < options.frames; ++f) {
      add_frame(f * unknowns, f, k, b);
      for (int node = 0; node < nodes; ++node)
        for (int d = 0; d < 2; ++d) {
          const int i = f * unknowns + 3 * node + d;
          m(i, i) = 20e3;
          if (d == 0) system.load(i, 0) = options.mirrored && f == 1 ? -20e3 : 20e3;
          if (d == 0 && f == 0) base[i] = 1;
        }
    }
    first_frequency = frequencies(k, m)[0];
    for (int f = 0; f < options.frames; ++f)
      system.groups.push_back({.first = f * unknowns,
                               .count = unknowns,
                               .displacement_floor = 1e-6,
                               .velocity_floor = 1e-5,
                               .by_mass = 2 * 0.05 * first_frequency});
    system.mass = m.sparseView();
    system.stiffness = k.sparseView();
    system.damping.resize(n, n);
    system.gap_jacobian = options.elastic ? SparseMatrix(n, 0) : SparseMatrix(b.sparseView());
    system.grounds = {ground};
    std::vector<Eigen::Triplet<double>> rows;
    for (int f = 0; f < options.frames; ++f)
      for (int floor = 0; floor < s; ++floor) rows.emplace_back(f * unknowns + 6 * floor, f * s + floor, 1);
    system.outputs.resize(n, s * options.frames);
    system.outputs.setFromTriplets(rows.begin(), rows.end());
    if (!options.elastic)
      for (const auto& spring : springs) system.elements.push_back(spring.get());
  }

  int hinges() const { return static_cast<int>(springs.size()); }

  /// Adds one contact between the top floors of two frames: its column of B precedes those of the springs.
  void add_contact(std::unique_ptr<const Contact> contact) {
    Eigen::MatrixXd wider = Eigen::MatrixXd::Zero(system.size(), system.links() + 1);
    wider.rightCols(system.links()) = Eigen::MatrixXd(system.gap_jacobian);
    wider(6 * options.storeys - 3, 0) = 1;
    wider(unknowns + 6 * options.storeys - 6, 0) = -1;
    system.gap_jacobian = wider.sparseView();
    contacts.push_back(std::move(contact));
    system.contacts.push_back(contacts.back().get());
  }

 private:
  static Eigen::VectorXd frequencies(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m) {
    const dense::Condensed condensed = dense::condense(k, m);
    return dense::modes(condensed.stiffness, condensed.mass).squares.cwiseSqrt();
  }

  // Euler-Bernoulli, degrees of freedom x z r (counter-clockwise) at both ends; negative for fixed ones.
  static void add_beam(double area, double inertia, double dx, double dz, const std::array<int, 6>& where,
                       Eigen::MatrixXd& k) {
    constexpr double young = 30e9;
    const double l = std::hypot(dx, dz), c = dx / l, s = dz / l;
    Eigen::Matrix<double, 6, 6> local = Eigen::Matrix<double, 6, 6>::Zero(), turn = local;
    const double axial = young * area / l, bend = young * inertia / (l * l * l);
    local(0, 0) = local(3, 3) = axial;
    local(0, 3) = local(3, 0) = -axial;
    const std::array<int, 4> bending{1, 2, 4, 5};
    Eigen::Matrix4d of_bending;
    of_bending << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l,
        -6 * l, 4 * l * l;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) local(bending[i], bending[j]) = bend * of_bending(i, j);
    for (const int end : {0, 3}) turn.block<3, 3>(end, end) << c, s, 0, -s, c, 0, 0, 0, 1;
    const Eigen::Matrix<double, 6, 6> global = turn.transpose() * local * turn;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        if (where[i] >= 0 && where[j] >= 0) k(where[i], where[j]) += global(i, j);
  }

  void add_spring(double stiffness, double yields, const Eigen::VectorXd& row, Eigen::MatrixXd& k, Eigen::MatrixXd& b) {
    k += stiffness * row * row.transpose();
    b.conservativeResize(Eigen::NoChange, b.cols() + 1);
    b.rightCols<1>() = row;
    springs.push_back(std::make_unique<BilinearSpring>(BilinearSpring::Parameters{
        .stiffness = stiffness, .yield_force = options.strength * yields, .hardening = 0.003}));
    spring_stiffness.push_back(stiffness);
    yield_moment.push_back(options.strength * yields);
  }

  void add_frame(int first, int frame, Eigen::MatrixXd& k, Eigen::MatrixXd& b) {
    constexpr double height = 3.2, width = 6.0, young = 30e9;
    constexpr double column = 0.4 * 0.4, column_inertia = column * 0.16 / 12, beam = 0.3 * 0.5,
                     beam_inertia = beam * 0.25 / 12;
    const int s = options.storeys, feet = first + 6 * s, ends = feet + 2;
    const auto node = [&](int storey, int line) { return first + 3 * (2 * (storey - 1) + line); };
    const double way = options.mirrored && frame == 1 ? -1 : 1;
    for (int storey = 1; storey <= s; ++storey)
      for (int line = 0; line < 2; ++line) {
        const int top = node(storey, line), bottom = storey > 1 ? node(storey - 1, line) : -1;
        add_beam(column, column_inertia, 0, height,
                 {bottom, bottom < 0 ? -1 : bottom + 1, bottom < 0 ? feet + line : bottom + 2, top, top + 1, top + 2},
                 k);
      }
    for (int storey = 1; storey <= s; ++storey) {
      const int left = node(storey, 0), right = node(storey, 1), own = ends + 2 * (storey - 1);
      add_beam(beam, beam_inertia, width, 0, {left, left + 1, own, right, right + 1, own + 1}, k);
    }
    const auto turn = [&](int at, int against) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(k.rows());
      row[at] = way;
      if (against >= 0) row[against] = -way;
      return row;
    };
    for (int line = 0; line < 2; ++line)
      add_spring(10 * 6 * young * column_inertia / height, 250e3, turn(feet + line, -1), k, b);
    for (int storey = 1; storey <= s; ++storey)
      for (int line = 0; line < 2; ++line)
        add_spring(10 * 6 * young * beam_inertia / width, 180e3,
                   turn(ends + 2 * (storey - 1) + line, node(storey, line) + 2), k, b);
  }
};

/// Results of a run, for the first frame only.
struct HingeFrameRun {
  std::size_t impacts = 0;
  std::vector<double> peak_floor, end_floor;         ///< [m]
  std::vector<double> ductility, peak_moment, slip;  ///< by hinge
  double base_shear = 0, hinge_work = 0;             ///< [N], [J]
  Energies energy;
  State end;
  long steps = 0, trials = 0, iterations = 0;
  double imbalance() const {
    return 1 - (energy.kinetic + energy.strain + energy.damping + energy.hysteretic + energy.impact + energy.devices) /
                   energy.input;
  }
};

/// Runs the frame from rest. `inside`: points per step at which the base shear is tracked.
inline HingeFrameRun run_hinge_frame(HingeFrame& frame, StructureSolver& solver, const StepperOptions& options,
                                     double end, int inside = 16,
                                     const std::function<void(StepController&)>& after_step = {}) {
  Stepper stepper(frame.system, solver, options);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(frame.system.size());
  stepper.start(0, zero, zero);
  StepController controller(stepper);
  ErrorControl policy(options.max_step);
  HingeFrameRun run;
  const int hinges = frame.options.elastic ? 0 : frame.hinges(), contacts = frame.system.contact_count();
  run.peak_floor.assign(static_cast<std::size_t>(frame.options.storeys), 0.0);
  run.ductility.assign(static_cast<std::size_t>(hinges), 0.0);
  run.peak_moment = run.ductility;
  const SparseMatrix columns = frame.system.gap_jacobian.middleCols(contacts, hinges);
  double h = options.max_step / 64;
  Eigen::VectorXd u, v, f;
  while (stepper.view().time() < end) {
    h = controller.advance(h, end, policy);
    ++run.steps;
    const OutputQuantities &x = stepper.view().outputs_begin(), &y = stepper.view().outputs_end_minus();
    for (int i = 0; i < frame.options.storeys; ++i) {
      run.peak_floor[i] = std::max(run.peak_floor[i], std::abs(y.motion(i, 0)));
      if (x.motion(i, 1) * y.motion(i, 1) >= 0) continue;
      const CubicPenetration between({x.motion(i, 0), x.motion(i, 1)}, {y.motion(i, 0), y.motion(i, 1)},
                                     y.time - x.time);
      run.peak_floor[i] = std::max(run.peak_floor[i], std::abs(between.at(between.turn())));
    }
    for (int i = 0; i < hinges; ++i)
      for (const LinkStep& step = stepper.view().link_steps()[contacts + i];
           const auto& [motion, force] :
           {std::pair(step.motion_middle, step.force_middle), std::pair(step.motion_end, step.force_end)}) {
        run.ductility[i] = std::max(run.ductility[i],
                                    std::abs(motion.penetration) * frame.spring_stiffness[i] / frame.yield_moment[i]);
        run.peak_moment[i] =
            std::max(run.peak_moment[i], std::abs(frame.spring_stiffness[i] * motion.penetration + force));
      }
    for (int k = 1; k <= inside; ++k) {
      const double t = x.time + (y.time - x.time) * k / inside;
      stepper.view().interpolate(t, u, v);
      stepper.view().interpolate_springs(t, f);
      run.base_shear = std::max(run.base_shear, std::abs(frame.base.dot(frame.system.stiffness * u + columns * f)));
    }
    if (after_step) after_step(controller);
  }
  run.trials = controller.trials();
  run.iterations = stepper.view().iterations();
  run.end = stepper.view().state();
  run.energy = stepper.view().energies();
  for (const ContactMemory& contact : stepper.view().memory().contacts) run.impacts += contact.impacts().size();
  for (int i = 0; i < frame.options.storeys; ++i) run.end_floor.push_back(stepper.view().outputs().motion(i, 0));
  for (int i = 0; i < hinges; ++i) {
    const double d = stepper.view().link_steps()[contacts + i].motion_end.penetration;
    const ConstElementMemory memory = stepper.view().memory().elements[i];
    const ElementEnergy energy = frame.springs[i]->energy(memory);
    run.slip.push_back(BilinearSpring::slip(memory));
    run.hinge_work += energy.lost + energy.stored_correction + 0.5 * frame.spring_stiffness[i] * d * d;
  }
  return run;
}

}  // namespace pounding::test
