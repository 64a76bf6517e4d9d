#pragma once
/// Solver in natural modes, in which the equations without links decouple.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include <pounding/linear/group_modes.hpp>
#include <pounding/linear/link_columns.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/model/reducible.hpp>

namespace pounding {

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
  /// Throws std::invalid_argument for a mass matrix that is not positive definite, for a massless degree of freedom
  /// without stiffness, and for a contact or dashpot at a massless one.
  explicit ModalSolver(const System& system);
  /// Same, with the given modes instead of all natural ones for each group that has a value. They must belong to the
  /// group's M and K.
  ModalSolver(const System& system, const std::vector<std::optional<ReducedGroup>>& groups);

  /// Largest number of dynamic degrees of freedom in one structure: the setup cost grows with its cube.
  static int max_dynamic_dofs(const System& system);

  void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const override;
  void stiffness_and_damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> kx,
                                   Eigen::Ref<Eigen::MatrixXd> cx) const override;
  void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const override { y = x; }
  void accelerate(Eigen::Ref<Eigen::VectorXd>) const override {}
  void recover(Eigen::Ref<Eigen::VectorXd>) const override {}
  bool prefers_dyadic_steps() const override { return !classical_; }
  void set_matrix(const EffectiveMatrix& matrix, const std::optional<int>& step_level) override;
  bool solve(Eigen::Ref<Eigen::VectorXd> x) override;
  bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) override;
  void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                    Eigen::Ref<Eigen::VectorXd> y) const override;
  void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const override {
    gap_jacobian_.gather(x, relative);
  }
  void gather(std::span<const int> /*links*/, Eigen::Ref<const Eigen::MatrixXd> x,
              Eigen::MatrixXd& relative) const override {
    gap_jacobian_.gather_chosen(x, relative);
  }
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override;
  void add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override;
  void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const override {
    outputs_.gather(x, values);
  }
  Eigen::VectorXd coordinates(const Eigen::VectorXd& physical) const override;
  void physical(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const override;
  std::span<const ReducedStructure> reduced() const override { return reduced_; }
  void gather_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const override {
    (shadow_ > 0 ? shadow_ends_ : gap_jacobian_).gather(x, relative);
  }
  void observe_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const override {
    (shadow_ > 0 ? shadow_outputs_ : outputs_).gather(x, values);
  }
  void physical_of_columns(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& u) const override;
  void as_shadow(const Eigen::MatrixXd& x, Eigen::MatrixXd& y) const override;
  std::optional<FewModes> few_modes(int group) const override;
  std::string description() const override;

 private:
  // Shared by groups with the same modes: Phi^T M, or Phi^T and M if few().
  struct Projection {
    Eigen::MatrixXd by_modes, by_unknown;
    SparseMatrix mass;
  };
  // The modes of one group, or of its shadow.
  struct Block {
    int first = 0;       // degree of freedom
    int coordinate = 0;  // first mode
    int count = 0;       // number of modes
    // Phi: [all degrees of freedom of the group, mode]; for a shadow, the modes of the run
    std::shared_ptr<const GroupModes> modes;
    std::shared_ptr<const ShadowModes> shadow;  // null unless this is a shadow
    std::shared_ptr<const Projection> projection;
    Eigen::MatrixXd damping;  // full C of these modes if not classical, otherwise empty
    // fraction of critical damping in each of these modes, in addition to the damping matrix of the system
    double modal_ratio = 0;
    bool reduced = false;   // fewer modes than dynamic degrees of freedom
    bool shadowed = false;  // a later block is its shadow

    const Eigen::MatrixXd& shapes() const { return modes->shapes; }
    Eigen::Index unknowns() const { return modes->shapes.rows(); }
    // Converts the matrix Phi^T X from the modes of the run to these modes.
    Eigen::MatrixXd of_modes(Eigen::MatrixXd by_run) const {
      return shadow ? Eigen::MatrixXd(shadow->in_modes.transpose() * by_run) : std::move(by_run);
    }
    // True if sums over the modes cost less than sums over the unknowns; sums then follow the order of the modes.
    bool few() const { return reduced || modes->shapes.cols() > small_structure; }
    // Displacements of the unknowns [columns of x, unknown of the system] from the modal coordinates x.
    void displace(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> u) const;
    // Displacements of one column [unknown of the group], if not few().
    void displace_one(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> u) const;
  };
  void add_natural(const System& system, const Group& group, const Block* equal);
  void add_reduced(const System& system, const Group& group, const ReducedGroup& reduced);
  void add_shadow(const System& system, const Group& group, const std::shared_ptr<const ShadowModes>& shadow);
  using Entry = std::pair<int, double>;
  template <class Column>
  LinkColumns columns_of(const SparseMatrix& matrix, bool shadow, const Column& column_of) const;
  static Eigen::VectorXd sum_of_shapes(const Block& block, const std::vector<Entry>& entries);
  LinkColumns columns_of_links(const System& system, bool shadow) const;
  LinkColumns columns_of_outputs(const System& system, bool shadow) const;
  void add_block(const System& system, const Group& group, Block block, const Eigen::MatrixXd& rest);
  void add_coordinates(const Group& group, Block block, const Eigen::MatrixXd& rest);
  LinkColumns::Solve solve_block() const;

  std::vector<Block> blocks_;
  Eigen::VectorXd single_;  // shapes of groups if each has one unknown, otherwise empty
  LinkColumns gap_jacobian_, outputs_;
  // Both in the shadow, and in the blocks that have none; empty without a shadow.
  LinkColumns shadow_ends_, shadow_outputs_;
  std::vector<ReducedStructure> reduced_;
  Eigen::VectorXd stiffness_, damping_;  // diagonals
  bool classical_ = true;
  int unknowns_ = 0;

  EffectiveMatrix matrix_{0, 0, 0};
  Eigen::VectorXd inverse_;                           // inverse of the diagonal of A
  bool has_flexibility_ = false;                      // for the selected links and the current matrix
  std::vector<Eigen::LLT<Eigen::MatrixXd>> factors_;  // by block, for the current matrix, if not classical
};

}  // namespace pounding
