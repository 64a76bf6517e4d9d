#pragma once
/// Instances of the kernel, compiled separately.

#include <stdexcept>
#include <type_traits>
#include <variant>

#include <pounding/study/history.hpp>

namespace pounding::study {

/// Two modes and one link, with sizes known at compile time.
Peaks run_pair(const LinearModel& model, const EvenRecord& record, const Settings& settings);
/// Up to eight modes, and any number of links: two or three buildings of a few storeys.
Peaks run_few(const LinearModel& model, const EvenRecord& record, const Settings& settings);
/// Any number of modes and links.
Peaks run_any(const LinearModel& model, const EvenRecord& record, const Settings& settings);

/// History for the law of the links.
template <int M, int L>
Peaks run_by_law(const LinearModel& model, const EvenRecord& record, const Settings& settings) {
  if (model.links.empty()) return History<laws::LinearSpring, M, L>(model, record, settings).run();
  return std::visit(
      [&](const auto& law) -> Peaks {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (laws::instantaneous<Law>)
          throw std::invalid_argument("the kernel takes penalty laws");
        else
          return History<Law, M, L>(model, record, settings).run();
      },
      model.links.front().law);
}

}  // namespace pounding::study
