#pragma once
/// A frame with members of fibres: its forces from their states, and its state at rest. SI units.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

#include <pounding/frames/corotational.hpp>
#include <pounding/frames/fibre_member.hpp>
#include <pounding/frames/frame_model.hpp>
#include <pounding/frames/member_unknowns.hpp>
#include <pounding/structures/tangent_forces.hpp>

namespace pounding {

/// Some or all members are of fibres; springs and other members stay elastic, with large rotations if the frame is
/// corotational. The unknowns are those of the assembled frame, and its stiffness with uncracked members is K.
class FibreFrame final : public TangentForces {
 public:
  /// `model` and the frame assembled from it. Loads at rest are applied in steps to the undeformed members. Throws
  /// std::invalid_argument, with the member or the fraction of the load, for a member with hinges, releases or loads
  /// between its ends, and if the loads have no equilibrium.
  FibreFrame(const FrameModel& model, const AssembledFrame& assembled);

  const Eigen::VectorXd& at_rest() const override { return rest_; }
  std::unique_ptr<Motion> start() const override;
  void begin_step(Motion& motion) const override;
  double linearize(Motion& motion, const Eigen::VectorXd& u, Eigen::VectorXd& force,
                   Eigen::SparseMatrix<double>& tangent) const override;
  void record_stage(Motion& motion, const Eigen::VectorXd& u, double time) const override;
  bool accept(Motion& motion, double min_reversal) const override;
  Eigen::VectorXd member_forces(const Motion& motion, double s) const override;
  Energy energy(const Motion& motion, const Eigen::VectorXd& u) const override;

  /// Forces of a member of the frame at total displacements q and these forces in the members of fibres: on its ends in
  /// local axes, which rotate with it if the frame is corotational; on its nodes in global axes [N], [N m].
  Vector12 end_forces(int member, const Eigen::VectorXd& q, const Eigen::VectorXd& in_members) const;
  Vector12 nodal_forces(int member, const Eigen::VectorXd& q, const Eigen::VectorXd& in_members) const;
  /// Local axes of an elastic member, rotated with it, as rows.
  Eigen::Matrix3d axes(int member, const Eigen::VectorXd& q) const;

 private:
  struct States;
  struct Member {
    FibreMember beam;
    MemberUnknowns unknowns;
  };
  struct Elastic {
    Beam beam;
    std::optional<CorotationalBeam> turning;  // in a corotational frame
    MemberUnknowns unknowns;
  };

  void take_members(const FrameModel& model, const AssembledFrame& assembled);
  void load_slowly(const Eigen::VectorXd& load);
  bool find_equilibrium(States& states, Eigen::VectorXd& q, const Eigen::VectorXd& load) const;
  double add(States& states, const Eigen::VectorXd& q, Eigen::VectorXd& force,
             Eigen::SparseMatrix<double>& tangent) const;
  Energy energy_of(const States& states, const Eigen::VectorXd& q) const;

  std::vector<int> numbers_;
  std::vector<Member> members_;
  std::vector<Elastic> elastic_;
  std::vector<int> places_;             // of each member of the frame: its index, or -1 - index in elastic_
  Eigen::SparseMatrix<double> others_;  // stiffness of everything else, in the pattern of the tangent
  Eigen::VectorXd load_, rest_;         // at rest
  std::shared_ptr<const States> at_rest_;
  Energy energy_at_rest_;
};

}  // namespace pounding
