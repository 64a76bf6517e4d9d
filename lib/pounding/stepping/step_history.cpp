#include <pounding/stepping/step_history.hpp>

namespace pounding {

StepHistory::StepHistory(const Equations& equations)
    : trial_(std::make_unique<Trial>(equations.zero_trial())),
      kept_(std::make_unique<Trial>(*trial_)),
      previous_(std::make_unique<Trial>(*trial_)),
      changed_{trial_->end, trial_->end},
      now_(&changed_[0]),
      begin_(&kept_->end) {}

Instant& StepHistory::change_now() {
  changed_at_end_ = true;
  if (now_ == &changed_[0] || now_ == &changed_[1]) return *now_;
  Instant& own = changed_[begin_ == &changed_[0] ? 1 : 0];
  own = *now_;
  now_ = &own;
  return own;
}

void StepHistory::keep_trial() {
  begin_ = now_;
  previous_.swap(kept_);
  kept_.swap(trial_);
  now_ = &kept_->end;
  changed_at_end_ = false;
}

void StepHistory::collapse() {
  kept_->end = *now_;
  begin_ = &kept_->end;
}

void StepHistory::restart() {
  collapse();
  trial_->end = *now_;
  kept_->h = 0;
  kept_->a_middle = now_->motion.col(Instant::a);
}

void StepHistory::archive(Archive& archive) {
  if (archive.reading()) {
    now_ = &changed_[0];
    begin_ = &previous_->end;
  }
  archive(*now_);
  archive(*begin_);
  archive(*kept_);
  archive(changed_at_end_);
}

}  // namespace pounding
