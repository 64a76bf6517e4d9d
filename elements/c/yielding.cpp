/// Hysteretic laws for C.

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include <pounding/hysteresis/all.hpp>

#include "guarded.hpp"
#include "pounding.h"

struct pnd_yielding {
  pounding::hysteresis::AnyLaw law;
};

namespace {

namespace hysteresis = pounding::hysteresis;
namespace laws = pounding::laws;
using pounding::c::guarded;
using pounding::c::item_at;
using pounding::c::require;

void require_new(bool is_new, std::string_view name) {
  if (!is_new) throw std::invalid_argument(pounding::excerpt(name) + " is given twice");
}

hysteresis::Settings settings(const char* law, const pnd_value* values, size_t count, const pnd_word* words,
                              size_t word_count) {
  hysteresis::Settings s{.law = law};
  for (size_t i = 0; i < count; ++i) {
    require(values[i].name, "name of a value");
    require_new(s.values.emplace(values[i].name, values[i].value).second, values[i].name);
  }
  for (size_t i = 0; i < word_count; ++i) {
    require(words[i].name, "name of a keyword");
    require(words[i].word, "keyword");
    require_new(s.words.emplace(words[i].name, words[i].word).second, words[i].name);
  }
  return s;
}

const hysteresis::Entry& yielding_at(size_t law) {
  return item_at(hysteresis::catalogue(), law, "the catalogue", "hysteretic law");
}

// Stores a value unless the caller passed a null pointer for the array.
void put(double* list, size_t i, double value) {
  if (list) list[i] = value;
}

template <hysteresis::Law L>
void follow(const L& law, const double* path, size_t count, double* force, double* tangent, double* lost) {
  typename L::State kept;
  double work = 0;
  for (size_t i = 0; i < count; ++i) {
    const hysteresis::Answer answer = law.respond(kept, path[i]);
    put(force, i, answer.force);
    put(tangent, i, answer.slope);
    if (lost) work += law.work(kept, path[i]);
    kept = law.advance(kept, path[i]);
    if (lost) lost[i] = work - law.stored(kept);
  }
}

}  // namespace

int pnd_create_yielding(const char* law, const pnd_value* values, size_t count, const pnd_word* words,
                        size_t word_count, pnd_yielding** made) {
  return guarded([&] {
    require(made, "made");
    *made = nullptr;
    require(law, "law");
    if (count > 0) require(values, "values");
    if (word_count > 0) require(words, "words");
    *made = new pnd_yielding{hysteresis::make_law(settings(law, values, count, words, word_count))};
  });
}

void pnd_destroy_yielding(pnd_yielding* law) { delete law; }

int pnd_follow(const pnd_yielding* law, const double* deformation, size_t count, double* force, double* tangent,
               double* lost) {
  return guarded([&] {
    require(law, "law");
    if (count > 0) require(deformation, "deformation");
    for (size_t i = 0; i < count; ++i)
      if (!std::isfinite(deformation[i]))
        laws::refuse("deformation[" + std::to_string(i) + "]", deformation[i], "finite");
    std::visit([&](const auto& chosen) { follow(chosen, deformation, count, force, tangent, lost); }, law->law);
  });
}

int pnd_yielding_start(const pnd_yielding* law, double* stiffness, double* yield_deformation) {
  return guarded([&] {
    require(law, "law");
    std::visit(
        [&](const auto& chosen) {
          put(stiffness, 0, chosen.stiffness());
          put(yield_deformation, 0, chosen.yield_deformation());
        },
        law->law);
  });
}

size_t pnd_yielding_count(void) { return hysteresis::catalogue().size(); }

// The texts are string literals, so data() is null-terminated.
int pnd_describe_yielding(size_t law, pnd_yielding_info* info) {
  return guarded([&] {
    require(info, "info");
    const hysteresis::Entry& e = yielding_at(law);
    *info = {e.name.data(), e.shape.data(), e.summary.data(), e.source.data(), e.parameters.size(), e.choices.size()};
  });
}

int pnd_describe_yielding_parameter(size_t law, size_t parameter, pnd_parameter_info* info) {
  return guarded([&] {
    require(info, "info");
    const hysteresis::Entry& e = yielding_at(law);
    const hysteresis::ParameterInfo& p = item_at(e.parameters, parameter, e.name, "parameter");
    *info = {p.name.data(), p.unit.data(), p.meaning.data(), p.typical,
             p.need == hysteresis::Need::required ? PND_REQUIRED : PND_OPTIONAL};
  });
}

int pnd_describe_yielding_choice(size_t law, size_t choice, size_t word, pnd_choice_info* info) {
  return guarded([&] {
    require(info, "info");
    const hysteresis::Entry& e = yielding_at(law);
    const hysteresis::ChoiceInfo& c = item_at(e.choices, choice, e.name, "choice");
    *info = {c.name.data(), c.meaning.data(), item_at(c.words, word, c.name, "keyword").data(), c.words.size()};
  });
}
