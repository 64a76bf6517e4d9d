#include <pounding/results/parts_file.hpp>

#include <string>

namespace pounding {
namespace {

using namespace hdf5;
using Names = std::vector<std::string>;

// Interleaves minimum and maximum values.
std::vector<double> paired(const std::vector<double>& minimum, const std::vector<double>& largest, std::size_t count) {
  std::vector<double> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    pairs.push_back(minimum[i]);
    pairs.push_back(largest[i]);
  }
  return pairs;
}

struct Quantity {
  const char *name, *time_name, *units, *long_name;
};

// Writes the first `places` rows of a quantity with these directions or components.
void write(hid_t parent, const Quantity& quantity, const Extremes& extremes, std::size_t places, const Names& along,
           const char* word, const StructureEnvelope* forces = nullptr) {
  if (extremes.size() == 0) return;
  const std::size_t count = places * along.size();
  const Handle values = array(parent, {quantity.name, quantity.units, quantity.long_name},
                              paired(extremes.min, extremes.max, count), {places, along.size(), 2});
  attribute(values, word, along);
  if (forces) {
    attribute(values, "gravity_included", static_cast<int>(forces->with_gravity));
    attribute(values, "included", forces->included);
  }
  const std::string long_name = std::string("times of ") + quantity.name;
  array(parent, {quantity.time_name, "s", long_name.c_str()}, paired(extremes.t_min, extremes.t_max, count),
        {places, along.size(), 2});
}

}  // namespace

void write_envelopes(hid_t file, const std::vector<StructureHistory>& structures) {
  const Handle place = group(group(file, "envelopes"), "structures");
  for (const StructureHistory& history : structures) {
    const StructureEnvelope& e = history.envelope;
    const Handle one = group(place, history.name);
    const std::size_t floors = history.floors.size();
    attribute(one, "floors", history.floors);
    const Names along = history.storey_directions() == 1 ? Names{"x"} : Names{"x", "y"};
    write(one, {"displacement", "displacement_time", "m", "minimum and maximum displacement relative to the ground"},
          e.displacement, floors, history.directions, "directions");
    write(one,
          {"edge_displacement", "edge_displacement_time", "m",
           "minimum and maximum displacement of an edge of a rigid floor along itself"},
          e.edge_displacement, floors, Names(e.edges.begin(), e.edges.end()), "edges");
    write(one, {"acceleration", "acceleration_time", "m/s^2", "minimum and maximum absolute acceleration"},
          e.acceleration, floors, history.directions, "directions");
    write(one, {"drift", "drift_time", "m", "minimum and maximum storey drift"}, e.drift, floors, along, "directions");
    write(one,
          {"storey_shear", "storey_shear_time", "N", "minimum and maximum shear force of the storey below the floor"},
          e.storey_shear, floors, along, "directions");
    write(one, {"base_shear", "base_shear_time", "N", "minimum and maximum shear force of the lowest storey"},
          e.storey_shear, 1, along, "directions");
    if (!e.members.empty()) {
      texts(one, "members", "names of the members", e.members);
      write(one,
            {"member_force", "member_force_time", "N",
             "minimum and maximum force [N] or moment [N m] on an end of a member, local axes"},
            e.member_force, e.members.size(), e.components, "components", &e);
      write(one,
            {"axial_force", "axial_force_time", "N",
             "minimum and maximum axial force of a member over both ends, positive in tension"},
            axial_forces(e), e.members.size(), {"N"}, "components", &e);
    }
    if (!e.supports.empty()) {
      texts(one, "supports", "names of the nodes that the ground holds", e.supports);
      write(one,
            {"reaction", "reaction_time", "N",
             "minimum and maximum force [N] or moment [N m] of the ground on the structure"},
            e.reaction, e.supports.size(), e.directions, "directions", &e);
    }
  }
}

}  // namespace pounding
