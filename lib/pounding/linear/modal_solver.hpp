#pragma once
/// Solver in natural modes, in which the equations without links decouple.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include <pounding/linear/group_modes.hpp>
#include <pounding/linear/link_columns.hpp>
#include <pounding/linear/natural_modes.hpp>
#include <pounding/linear/structure_solver.hpp>

namespace pounding {

struct ModalOptions {
  /// Groups to include, ascending; nullopt for all. Links, outputs and degrees of freedom of others count as zero.
  std::optional<std::vector<int>> groups{};
  /// Natural modes shared with other solvers; null for its own.
  std::shared_ptr<NaturalModes> natural{};
};

/// Uses all mass-normalised modes of each group, u = Phi q: M becomes the identity and K diagonal, so a step of any
/// length costs a few operations per degree of freedom and no factorization. Massless degrees of freedom are statically
/// condensed, which is exact. C is diagonal too if the damping is classical (Rayleigh or modal); otherwise it is a full
/// block per group, and each step length is factored once. In a basis other than the natural modes, modal damping
/// applies to the modes of that basis, whether or not the system has a damping matrix.
///
/// Groups with equal mass and stiffness, such as identical buildings, share their modes, which are computed once.
///
/// For small and medium systems: the setup cost grows with the cube of the number of dynamic degrees of freedom of a
/// structure.
class ModalSolver final : public StructureSolver {
 public:
  /// A given basis must belong to the group's M and K. Throws std::invalid_argument for a mass matrix that is not
  /// positive definite, for a massless degree of freedom without stiffness, and for a contact or dashpot at a massless
  /// one.
  explicit ModalSolver(const System& system, const ReducedGroups& bases = {}, const ModalOptions& options = {});

  /// Largest number of dynamic degrees of freedom in one structure: the setup cost grows with its cube.
  static int max_dynamic_dofs(const System& system);

  Eigen::VectorXd coordinates(const Eigen::VectorXd& physical) const override;
  Eigen::MatrixXd physical(Eigen::Ref<const Eigen::MatrixXd> x) const override;
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
    gap_jacobian_.gather(x, relative);
  }
  void gather(std::span<const int> /*links*/, Eigen::Ref<const Eigen::MatrixXd> x,
              Eigen::MatrixXd& relative) const override {
    gap_jacobian_.gather_chosen(x, relative);
  }
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override {
    gap_jacobian_.add_forces(factor, f, y);
  }
  bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) override;
  /// Selects the links of add_response() without computing their flexibility.
  void select(std::span<const int> links) { has_flexibility_ = !gap_jacobian_.choose(links) && has_flexibility_; }
  void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                    Eigen::Ref<Eigen::VectorXd> y) const override;
  void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const override {
    outputs_.gather(x, values);
  }

  std::string description() const override;

 private:
  // The modes of one group.
  struct Block {
    int first = 0;       // degree of freedom
    int coordinate = 0;  // first mode
    std::shared_ptr<const GroupModes> modes;
    Eigen::MatrixXd damping;  // full C of these modes if not classical, otherwise empty

    const Eigen::MatrixXd& shapes() const { return modes->shapes; }
    Eigen::Index unknowns() const { return modes->shapes.rows(); }
    Eigen::Index count() const { return modes->shapes.cols(); }
  };
  void add_block(const System& system, int group, const ReducedGroup* basis, NaturalModes& natural);
  LinkColumns columns_of(const SparseMatrix& matrix) const;
  LinkColumns::Solve solve_block() const;

  std::vector<Block> blocks_;
  SparseMatrix mass_;
  LinkColumns gap_jacobian_, outputs_;
  Eigen::VectorXd stiffness_, damping_;  // diagonals
  bool classical_ = true;

  EffectiveMatrix matrix_{0, 0, 0};
  Eigen::VectorXd inverse_;                           // inverse of the diagonal of A
  bool has_flexibility_ = false;                      // for the selected links and the current matrix
  std::vector<Eigen::LLT<Eigen::MatrixXd>> factors_;  // by block, for the current matrix, if not classical
  long factorizations_ = 0;
};

}  // namespace pounding
