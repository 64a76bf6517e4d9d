#include <pounding/results/parts_file.hpp>

#include <vector>

namespace pounding {
namespace {

using namespace hdf5;

struct SummaryField {
  Label label;
  double SpringSummary::* value;
};

constexpr SummaryField summary_fields[] = {
    {{"peak_deformation", "m", "deformation of largest magnitude, signed; for hinges [rad]"}, &SpringSummary::peak},
    {{"peak_time", "s", "time of peak_deformation"}, &SpringSummary::peak_time},
    {{"peak_force", "N", "largest absolute force; for hinges [N m]"}, &SpringSummary::peak_force},
    {{"ductility", "1",
      "largest ratio of deformation to the yield deformation in its direction; for hinges, of the rotation of the "
      "member end to its yield rotation"},
     &SpringSummary::ductility},
    {{"peak_plastic", "m", "largest absolute plastic deformation; for hinges [rad]"}, &SpringSummary::plastic},
    {{"cycles", "1", "half the number of swings that exceed the sum of both yield deformations"},
     &SpringSummary::cycles},
    {{"residual", "m", "deformation at the end of the run, possibly still moving; for hinges [rad]"},
     &SpringSummary::residual},
    {{"hysteretic", "J", "energy dissipated by yielding"}, &SpringSummary::energy_lost},
    {{"first_yield", "s", "time at which the yield deformation was first exceeded; NaN if never"},
     &SpringSummary::first_yield},
    {{"damping_shear", "1", "largest damping force across the storey divided by its yield force; NaN for hinges"},
     &SpringSummary::damping_shear},
};

void write_summary(hid_t place, const SpringHistory& springs) {
  const Handle summary = group(place, "summary");
  const std::vector<SpringSummary> rows = summaries(springs);
  for (const SummaryField& field : summary_fields) {
    std::vector<double> values;
    for (const SpringSummary& row : rows) values.push_back(row.*field.value);
    array(summary, field.label, values, {values.size()});
  }
  std::vector<std::string> states;
  for (const SpringSummary& row : rows) states.emplace_back(row.state());
  texts(summary, "state", "elastic, yielded once at least, or beyond ultimate", states);
}

}  // namespace

void write_springs(hid_t structure, const std::string& name, const SpringHistory& springs, std::size_t samples) {
  if (springs.size() == 0) return;
  const Handle place = group(structure, "springs");
  texts(place, "names", "names of the parts that yield", springs.names);
  texts(place, "laws", "laws of their forces", springs.laws);
  array(place, {"stiffness", "N/m", "initial stiffness; of hinges [N m/rad]"}, springs.stiffness, {springs.size()});
  std::vector<double> positive, negative;
  for (const YieldLimits& limits : springs.limits) {
    positive.push_back(limits.positive);
    negative.push_back(limits.negative);
  }
  array(place, {"yield_deformation", "m", "deformation at the first yield; for hinges [rad]"}, positive,
        {springs.size()});
  array(place, {"negative_yield_deformation", "m", "magnitude in the negative direction; for hinges [rad]"}, negative,
        {springs.size()});
  array(place, {"ultimate_rotation", "rad", "ultimate plastic rotation of a hinge; NaN if not given"}, springs.ultimate,
        {springs.size()});
  const auto history = [&](const Label& label, const std::vector<double>& values) {
    check_length(values.size(), samples * springs.size(), name + ": springs, " + label.name);
    array(place, label, values, {samples, springs.size()});
  };
  history({"deformation", "m", "drift of a storey, elongation of a device; rotation of a hinge [rad]"},
          springs.deformation);
  history({"force", "N", "shear of a storey, tension of a device; moment of a hinge [N m]"}, springs.force);
  history({"hysteretic", "J", "cumulative energy dissipated by yielding, and by the damper of a device"},
          springs.hysteretic);
  write_summary(place, springs);
}

}  // namespace pounding
