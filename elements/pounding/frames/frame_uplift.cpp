#include <pounding/frames/frame_parts.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/refuse.hpp>
#include <pounding/core/units.hpp>
#include <pounding/structures/make_spring.hpp>

namespace pounding {
namespace {

std::string name_of(const FrameModel& model, const FrameUplift& uplift) {
  return "support " + model.frame.node_name(uplift.node);
}

[[noreturn]] void refuse_uplift(const FrameModel& model, const FrameUplift& uplift, const std::string& why) {
  refuse(name_of(model, uplift) + ": " + why);
}

void require_mass(const FrameModel& model, const FrameUplift& uplift, const AssembledFrame& frame,
                  const Row& deformation) {
  if (deformation.nonZeros() == 0)
    refuse_uplift(model, uplift, "uz of its node is fixed; remove it from fix, so that the spring supports the node");
  for (Row::InnerIterator it(deformation); it; ++it)
    if (frame.massless[it.index()])
      refuse_uplift(
          model, uplift,
          fmt::format("its node has no mass, so a lifted foot has no inertia; type masses: {{\"{}\": 2 t}} for "
                      "the foot",
                      model.frame.node_name(uplift.node)));
}

// Compression of the spring at rest [N].
double preload_of(const FrameModel& model, const FrameUplift& uplift, const Row& deformation, const Structure& s) {
  const double force = s.at_rest.size() > 0 ? -uplift.stiffness * deformation.dot(s.at_rest) : 0;
  if (!(force > 0))
    refuse_uplift(model, uplift,
                  fmt::format("acts in compression only, but its force at rest is {}{}; increase the load that it "
                              "carries, or remove acts_in",
                              format_quantity(std::abs(force), dimension::force, 4), force < 0 ? " in tension" : ""));
  return force;
}

}  // namespace

void place_uplifts(FrameModel& model) {
  if (model.uplifts.empty()) return;
  const FrameUplift& first = model.uplifts.front();
  if (!model.is_linear())
    refuse_uplift(model, first,
                  fmt::format("acts_in: compression is not available with {}; {}", model.nonlinear_key(),
                              instead_of_nonlinear(model, "acts_in")));
  if (model.is_free) refuse_uplift(model, first, "a free frame has no supports; remove the spring");
  if (!model.is_loaded())
    refuse_uplift(model, first,
                  "acts in compression only, so its load at rest is required; type gravity: true, or give loads");
  for (std::size_t i = 0; i < model.uplifts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      if (model.uplifts[j].node == model.uplifts[i].node)
        refuse_uplift(model, model.uplifts[i], "has two springs that act in compression only; keep one of the two");
    model.frame.add_spring(model.uplifts[i].node, Dof::uz, model.uplifts[i].stiffness);
  }
}

void let_supports_uplift(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                         Structure& s) {
  if (model.uplifts.empty()) return;
  if (model.supports.size() > 1)
    refuse_uplift(model, model.uplifts.front(),
                  "a frame that lifts off needs the same motion at all supports; remove their delay and ground_motion, "
                  "or acts_in");
  const int first_part = static_cast<int>(s.yielding.size());
  std::vector<std::pair<int, Dof>> springs;
  for (const FrameUplift& uplift : model.uplifts) {
    Row deformation = frame.motion(uplift.node, Dof::uz);
    require_mass(model, uplift, frame, deformation);
    const double preload = preload_of(model, uplift, deformation, s);
    // The deformation is measured from rest, where the law has no force.
    YieldingPart& part = s.yielding.emplace_back(
        name_of(model, uplift), std::move(deformation), "uplift",
        std::vector<YieldingPart::Parameter>{
            {"stiffness", uplift.stiffness}, {"preload", preload}, {"lifts_at", preload / uplift.stiffness}},
        make_spring({.law = "uplift", .values = {{"stiffness", uplift.stiffness}, {"preload", preload}}}));
    part.kind = YieldingPart::Kind::support;
    springs.emplace_back(uplift.node, Dof::uz);
  }
  add_part_reactions(model, reactions, springs, first_part, s);
}

}  // namespace pounding
