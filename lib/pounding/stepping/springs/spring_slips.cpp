#include <pounding/stepping/springs/spring_slips.hpp>

#include <cmath>

namespace pounding {

SpringSlips::SpringSlips(const LinkSet& links)
    : links_(links), is_slipping_(static_cast<std::size_t>(links.springs()), false) {
  for (int i = 0; i < links.springs(); ++i)
    if (links.spring(links.contacts() + i).slips()) {
      is_slipping_[i] = true;
      slipping_.push_back(i);
    }
}

void SpringSlips::start(Instant& x) const {
  for (const int i : slipping_) {
    const int link = links_.contacts() + i;
    x.slip[i] = links_.spring(link).first_slip(links_.motion(link, x));
  }
}

Eigen::VectorXd SpringSlips::rates(const Instant& x) const {
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(links_.springs());
  for (const int i : slipping_) {
    const int link = links_.contacts() + i;
    rates[i] = links_.spring(link).slip_rate(links_.motion(link, x));
  }
  return rates;
}

void SpringSlips::find_middle(const Instant& x, Trial& trial) const {
  const Eigen::VectorXd begin = rates(x), end = rates(trial.end);
  for (const int i : slipping_)
    trial.middle[links_.contacts() + i].slip =
        0.5 * (x.slip[i] + trial.end.slip[i]) + trial.h / 8 * (begin[i] - end[i]);
}

void SpringSlips::add_simpson_error(const Instant& x, const Trial& trial, double part, StepError& error) const {
  const Eigen::VectorXd begin = rates(x), end = rates(trial.end);
  for (const int i : slipping_) {
    const int link = links_.contacts() + i;
    const double middle = links_.spring(link).slip_rate(trial.middle[link]);
    const double missed = part * (trial.h / 6 * (begin[i] + 4 * middle + end[i]) - (trial.end.slip[i] - x.slip[i]));
    if (std::abs(missed) > std::abs(error.slip[i])) error.slip[i] = missed;
  }
}

}  // namespace pounding
