#pragma once
/// Reduced structures with the error-estimating shadow of each: the same structure in fewer modes.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pounding/linear/modal_solver.hpp>

namespace pounding {

/// A ModalSolver with the coordinates of the shadows behind its own. Shadows are driven by the same link forces and
/// ground motions, and do not affect the run, which is bitwise identical without them. Links, outputs, weights and
/// segments exclude them. Comparing their motion with that of the run estimates the reduction error.
class ShadowedSolver final : public StructureSolver {
  template <class Vectors>
  auto run_of(Vectors& x) const {
    return x.topRows(run_.size());
  }
  template <class Vectors>
  auto shadow_of(Vectors& x) const {
    return x.bottomRows(shadow_.size());
  }

 public:
  /// As ModalSolver; at least one basis has a shadow.
  ShadowedSolver(const System& system, const ReducedGroups& bases);

  /// As gather() and observe(), from the shadow for structures that have one.
  void gather_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const;
  void observe_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const;
  /// Motion of each structure minus that of its shadow, in the coordinates of the run; zero for structures without a
  /// shadow.
  Eigen::MatrixXd difference(const Eigen::MatrixXd& x) const;

  Eigen::VectorXd coordinates(const Eigen::VectorXd& physical) const override;
  Eigen::MatrixXd physical(Eigen::Ref<const Eigen::MatrixXd> x) const override { return run_.physical(run_of(x)); }
  void add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override;

  void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const override;
  void damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                     Eigen::Ref<Eigen::MatrixXd> y) const override;
  void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const override { y = x; }
  void accelerate(Eigen::Ref<Eigen::VectorXd>) const override {}
  void recover(Eigen::Ref<Eigen::VectorXd>) const override {}
  void set_matrix(const EffectiveMatrix& matrix, const std::optional<int>& step_level) override;
  bool solve(Eigen::Ref<Eigen::VectorXd> x) override;

  void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const override {
    run_.gather(run_of(x), relative);
  }
  void gather(std::span<const int> links, Eigen::Ref<const Eigen::MatrixXd> x,
              Eigen::MatrixXd& relative) const override {
    run_.gather(links, run_of(x), relative);
  }
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override;
  bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) override;
  void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                    Eigen::Ref<Eigen::VectorXd> y) const override;
  void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const override {
    run_.observe(run_of(x), values);
  }

  std::string description() const override { return run_.description(); }

 private:
  // Modes of a shadow in terms of those of the run.
  struct Basis {
    Segment run;
    int first = 0;  // coordinate of the shadow
    std::shared_ptr<const ShadowModes> modes;
  };
  bool has_others() const { return bases_.size() < layout_.segments.size(); }
  Eigen::MatrixXd others_of(const Eigen::Ref<const Eigen::MatrixXd>& x) const;

  ModalSolver run_, shadow_;
  std::vector<Basis> bases_;
};

}  // namespace pounding
