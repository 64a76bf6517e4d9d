#include "pounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <pounding/laws/free_impact.hpp>
#include <pounding/links/accepted_state.hpp>
#include <pounding/links/contact_state.hpp>

#include "guarded.hpp"

struct pnd_law {
  pounding::laws::AnyLaw law;
};

namespace {

// A fixed-size array: reporting an out-of-memory error allocates nothing, and threads need no cleanup.
thread_local std::array<char, 512> last_error{};

}  // namespace

namespace pounding::c {

pnd_status fail(pnd_status status, std::string_view text) noexcept {
  std::size_t length = std::min(text.size(), last_error.size() - 1);
  // Does not truncate within a multi-byte UTF-8 character.
  while (length < text.size() && length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80) --length;
  std::copy_n(text.data(), length, last_error.data());
  last_error[length] = '\0';
  return status;
}

}  // namespace pounding::c

namespace {

namespace laws = pounding::laws;
using pounding::ContactPhase;
using pounding::c::guarded;
using pounding::c::item_at;
using pounding::c::require;

static_assert(sizeof(pnd_contact) == PND_CONTACT_DOUBLES * sizeof(double));

void require_finite(const char* name, double value) {
  if (!std::isfinite(value)) laws::refuse(name, value, "finite");
}

laws::Settings settings(const char* law, const char* formula, const pnd_value* values, size_t count) {
  laws::Settings s{.law = law, .formula = formula ? formula : ""};
  std::vector<std::string_view> seen;
  for (size_t i = 0; i < count; ++i) {
    require(values[i].name, "name of a value");
    const std::string_view name = values[i].name;
    if (std::ranges::find(seen, name) != seen.end())
      throw std::invalid_argument(pounding::excerpt(name) + " is given twice");
    seen.push_back(name);
    if (name == "restitution")
      s.restitution = values[i].value;
    else if (name == "impact_velocity")
      s.impact_velocity = values[i].value;
    else if (name == "reduced_mass")
      s.reduced_mass = values[i].value;
    else
      s.values.emplace(name, values[i].value);
  }
  return s;
}

// The gap of the host is not part of the interface: the state contains only the indentation.
pounding::ContactState state_of(const pnd_contact& c) noexcept {
  return {.phase = c.touching != 0 ? ContactPhase::approach : ContactPhase::open,
          .impact = {.closing_speed = c.closing_speed,
                     .damping = c.damping,
                     .largest_penetration = c.largest_penetration,
                     .slip = c.slip,
                     .crushed = c.crushed},
          .gap = c.indentation};
}

// Between impacts a pnd_contact contains only its indentation and the crushed depth.
void put(const pounding::ContactState& state, pnd_contact& c) noexcept {
  const bool touching = presses(state.phase);
  const laws::Impact impact = touching ? state.impact : laws::Impact{.crushed = state.impact.crushed};
  c.touching = touching ? 1 : 0;
  c.indentation = state.gap;
  c.closing_speed = impact.closing_speed;
  c.damping = impact.damping;
  c.largest_penetration = impact.largest_penetration;
  c.slip = impact.slip;
  c.crushed = impact.crushed;
}

// Updates the history with `change(law, state)`; the contact is unchanged if it throws.
template <class Change>
void update(const pnd_law* law, pnd_contact& contact, Change&& change) {
  pounding::ContactState state = state_of(contact);
  std::visit([&](const auto& chosen) { change(chosen, state); }, law->law);
  put(state, contact);
}

const laws::Entry& entry_at(size_t law) { return item_at(laws::catalogue(), law, "the catalogue", "law"); }

// The texts are string literals, so data() is null-terminated.
pnd_parameter_info info_of(const laws::ParameterInfo& p) noexcept {
  const int needs[] = {PND_REQUIRED, PND_OPTIONAL, PND_DAMPING, PND_TOGETHER};
  return {p.name.data(), p.unit.data(), p.meaning.data(), p.typical, needs[static_cast<int>(p.need)]};
}

std::vector<pnd_parameter_info> parameters_of(const laws::Entry& entry) {
  std::vector<pnd_parameter_info> list;
  for (const laws::ParameterInfo& p : entry.parameters) list.push_back(info_of(p));
  if (entry.takes_restitution)
    list.push_back(
        {"restitution", "",
         entry.sticks_at_zero ? "coefficient of restitution, in [0, 1]" : "coefficient of restitution, in (0, 1]",
         laws::typical_restitution, entry.direct_damping().empty() ? PND_REQUIRED : PND_DAMPING});
  if (entry.takes_impact_velocity)
    list.push_back({"impact_velocity", "m/s", "fixed design velocity; default: the closing speed of each impact",
                    laws::typical_closing_speed, PND_OPTIONAL});
  if (entry.takes_reduced_mass)
    list.push_back(
        {"reduced_mass", "kg", "m1 m2/(m1 + m2) of the colliding bodies", laws::typical_reduced_mass, PND_REQUIRED});
  return list;
}

}  // namespace

int pnd_interface(void) { return PND_INTERFACE; }
const char* pnd_version(void) { return POUNDING_VERSION; }
const char* pnd_error_text(void) { return last_error.data(); }

int pnd_create(const char* law, const char* formula, const pnd_value* values, size_t count, pnd_law** made) {
  return guarded([&] {
    require(made, "made");
    *made = nullptr;
    require(law, "law");
    if (count > 0) require(values, "values");
    *made = new pnd_law{laws::make_law(settings(law, formula, values, count))};
  });
}

void pnd_destroy(pnd_law* law) { delete law; }

int pnd_touch(const pnd_law* law, double closing_speed, pnd_contact* contact) {
  return guarded([&] {
    require(law, "law");
    require(contact, "contact");
    laws::require_not_negative("closing_speed", closing_speed);
    if (contact->touching != 0) throw std::invalid_argument("an impact is in progress; call pnd_separate to end it");
    update(law, *contact, [&](const auto& chosen, auto& state) { state.begin(chosen, closing_speed); });
  });
}

int pnd_respond(const pnd_law* law, const pnd_contact* contact, double penetration, double rate,
                pnd_response* response) {
  return guarded([&] {
    require(law, "law");
    require(contact, "contact");
    require(response, "response");
    require_finite("penetration", penetration);
    require_finite("rate", rate);
    const pounding::ContactState state = state_of(*contact);
    laws::Response r;
    if (presses(state.phase))
      r = std::visit(
          [&](const auto& chosen) { return chosen.respond(state.penetration(penetration), rate, state.impact); },
          law->law);
    *response = {r.force, r.by_penetration, r.by_rate};
  });
}

int pnd_accept(const pnd_law* law, double penetration, double rate, pnd_contact* contact) {
  return guarded([&] {
    require(law, "law");
    require(contact, "contact");
    require_finite("penetration", penetration);
    require_finite("rate", rate);
    update(law, *contact, [&](const auto& chosen, auto& state) { pounding::accept(chosen, penetration, rate, state); });
  });
}

int pnd_separate(const pnd_law* law, double penetration, pnd_contact* contact) {
  return guarded([&] {
    require(law, "law");
    require(contact, "contact");
    require_finite("penetration", penetration);
    if (contact->touching == 0)
      throw std::invalid_argument("no impact is in progress; call pnd_touch or pnd_accept to begin one");
    update(law, *contact,
           [&](const auto& chosen, auto& state) { state.end(chosen, std::max(state.penetration(penetration), 0.0)); });
  });
}

int pnd_collide(const pnd_law* law, double reduced_mass, double closing_speed, pnd_free_impact* result) {
  return guarded([&] {
    require(law, "law");
    require(result, "result");
    const laws::FreeImpact r = laws::free_impact(law->law, reduced_mass, closing_speed);
    *result = {r.restitution, r.peak_force, r.peak_penetration, r.time_of_peak, r.duration, r.impulse, r.energy_lost};
  });
}

size_t pnd_law_count(void) { return laws::catalogue().size(); }

int pnd_find_law(const char* name, size_t* law) {
  return guarded([&] {
    require(name, "name");
    require(law, "law");
    *law = static_cast<size_t>(&laws::find_law(name) - laws::catalogue().data());
  });
}

int pnd_describe_law(size_t law, pnd_law_info* info) {
  return guarded([&] {
    require(info, "info");
    const laws::Entry& e = entry_at(law);
    *info = {e.name.data(),     e.shape.data(), e.summary.data(),     e.source.data(), parameters_of(e).size(),
             e.formulas.size(), e.may_pull,     e.leaves_indentation, e.instantaneous};
  });
}

int pnd_describe_parameter(size_t law, size_t parameter, pnd_parameter_info* info) {
  return guarded([&] {
    require(info, "info");
    *info = item_at(parameters_of(entry_at(law)), parameter, entry_at(law).name, "parameter");
  });
}

int pnd_describe_formula(size_t law, size_t formula, pnd_formula_info* info) {
  return guarded([&] {
    require(info, "info");
    const laws::Entry& e = entry_at(law);
    const laws::Formula& f = item_at(e.formulas, formula, e.name, "formula");
    *info = {f.name.data(), f.source.data(), f.note.data()};
  });
}
