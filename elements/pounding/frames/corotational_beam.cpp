// A corotational member: elastic in the rotating axes.

#include <pounding/frames/corotational.hpp>

#include <array>

#include <pounding/core/refuse.hpp>

namespace pounding {

using Eigen::Matrix3d;
using Eigen::Vector3d;

CorotationalBeam::CorotationalBeam(const Vector3d& start_node, const Vector3d& end_node, const Section& section,
                                   const Material& material, const BeamOptions& options, int dimension)
    : CorotationalBeam(Beam(start_node, end_node, section, material, options), start_node, end_node, dimension) {}

CorotationalBeam CorotationalBeam::truss(const Vector3d& start_node, const Vector3d& end_node, double area,
                                         const Material& material, int dimension) {
  return {Beam::truss(start_node, end_node, area, material), start_node, end_node, dimension};
}

CorotationalBeam::CorotationalBeam(const Beam& beam, const Vector3d& start_node, const Vector3d& end_node,
                                   int dimension)
    : is_plane_(dimension == 2), motion_(beam, start_node, end_node) {
  if (beam.axial_force() != 0) refuse("a corotational member computes its axial force; remove axial_force");
  // Beam has condensed the releases; the other six displacements of its ends are zero in the rotated axes.
  constexpr std::array deformations{3, 4, 5, 6, 9, 10, 11};
  constexpr std::array plane{3, 1, 5};
  stiffness_ = beam.local_stiffness()(deformations, deformations);
  plane_stiffness_ = stiffness_(plane, plane);
}

CorotationalBeam::Response CorotationalBeam::respond(const Vector12& u, Matrix12* tangent) const {
  if (is_plane_) {
    const Corotation::Plane plane = motion_.plane(u);
    const Vector3d s = plane_stiffness_ * plane.deformations;
    if (tangent) *tangent = motion_.tangent(plane, s, plane_stiffness_);
    return {0.5 * plane.deformations.dot(s), motion_.nodal_forces(plane, s)};
  }
  const Corotation::Space space = motion_.space(u);
  const Corotation::Vector7 s = stiffness_ * space.deformations;
  if (tangent) *tangent = motion_.tangent(space, u, s, stiffness_);
  return {0.5 * space.deformations.dot(s), motion_.nodal_forces(space, u, s)};
}

Vector12 CorotationalBeam::end_forces(const Vector12& u) const {
  if (is_plane_) {
    const Corotation::Plane plane = motion_.plane(u);
    return motion_.end_forces(plane, plane_stiffness_ * plane.deformations);
  }
  const Corotation::Space space = motion_.space(u);
  return motion_.end_forces(space, stiffness_ * space.deformations);
}

}  // namespace pounding
