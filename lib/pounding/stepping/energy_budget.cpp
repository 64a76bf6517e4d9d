#include <pounding/stepping/energy_budget.hpp>

#include <algorithm>
#include <cmath>

namespace pounding {
namespace {

constexpr int steps_between_audits = 16;

}  // namespace

bool EnergyBudget::is_due() {
  if (++steps_ < steps_between_audits) return false;
  steps_ = 0;
  return true;
}

void EnergyBudget::audit(const Energies& e) {
  largest_ = std::max(largest_, std::abs(e.input));
  const double spent = std::abs(e.imbalance()) / (tolerance_ * std::max(largest_, minimum_ / ++audits_));
  share_ = spent > 0.5 ? std::pow(std::max(2 * (1 - spent), shortest_part), error_order_) : 1;
}

void EnergyBudget::archive(Archive& archive) { archive(largest_, share_, audits_, steps_); }

}  // namespace pounding
