#pragma once
/// Solver for structures whose stiffness in the matrix of a step is a tangent, next to linear ones in natural modes.

#include <Eigen/SparseCholesky>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pounding/linear/structure_solver.hpp>

namespace pounding {

/// The coordinates of a structure with TangentForces are its degrees of freedom, massless ones included, behind those
/// of the linear structures. Its block of A is mass M + damping C + stiffness K_t with the last tangent K_t, factored
/// when it is needed. Rayleigh damping proportional to K acts on the degrees of freedom with mass only: K is condensed
/// to them, so that joints without mass transmit no damping moments. Every process solves all blocks.
class TangentSolver final : public StructureSolver {
 public:
  /// `linear`: solver of all groups without TangentForces, with none of the others; null if there are none. `system`
  /// must outlive this object. Throws std::invalid_argument for a massless degree of freedom without stiffness, a
  /// contact or dashpot at a massless one, and modal damping of these structures.
  TangentSolver(const System& system, std::unique_ptr<StructureSolver> linear);

  Eigen::VectorXd coordinates(const Eigen::VectorXd& physical) const override;
  Eigen::MatrixXd physical(Eigen::Ref<const Eigen::MatrixXd> x) const override;
  void add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override;

  void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const override;
  void damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                     Eigen::Ref<Eigen::MatrixXd> y) const override;
  void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const override;
  void accelerate(Eigen::Ref<Eigen::VectorXd> r) const override;
  void recover(Eigen::Ref<Eigen::VectorXd> x) const override;
  void set_matrix(const EffectiveMatrix& matrix, const std::optional<int>& step_level) override;
  void set_tangent(int group, const SparseMatrix& tangent) override;
  bool solve(Eigen::Ref<Eigen::VectorXd> x) override;

  void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const override;
  void gather(std::span<const int> links, Eigen::Ref<const Eigen::MatrixXd> x,
              Eigen::MatrixXd& relative) const override;
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override;
  bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) override;
  void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                    Eigen::Ref<Eigen::VectorXd> y) const override;
  void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const override;

  std::string description() const override;

 private:
  using Factor = Eigen::SimplicialLDLT<SparseMatrix>;
  // One structure; matrices have its degrees of freedom.
  struct Block {
    int group, first, size, coordinate;  // first degree of freedom, first coordinate
    SparseMatrix mass, damping, stiffness, tangent;
    std::vector<int> dynamic, massless;
    std::unique_ptr<Factor> dynamic_mass, massless_stiffness;  // factors of M and K at these degrees of freedom
    SparseMatrix coupling;                                     // of K between massless and dynamic ones
    SparseMatrix closing, outputs;                             // rows of the gap Jacobian and of the outputs
    Factor step;                                               // of A
    Eigen::MatrixXd columns;                                   // Z = A^-1 B of the links of the last flexibility()
  };

  int linear_size() const { return linear_ ? linear_->size() : 0; }
  void add_block(const System& system, int group);
  bool factorize();
  // Calls at(block, rows of x) for each block.
  template <class At>
  void each(At&& at) const;

  std::unique_ptr<StructureSolver> linear_;
  std::vector<std::unique_ptr<Block>> blocks_;
  Eigen::MatrixXd of_linear_;  // flexibility of the links by the linear structures
  EffectiveMatrix matrix_{0, 0, 0};
  bool is_factored_ = false, ok_ = false;
  long factorizations_ = 0;
};

}  // namespace pounding
