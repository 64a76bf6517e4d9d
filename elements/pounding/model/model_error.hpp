#pragma once
/// Error in a model, with the option concerned.

#include <stdexcept>
#include <string>

namespace pounding {

/// Option of a model, a structure or a link that an error is about.
enum class ModelOption {
  // of the model
  analysis,
  checkpoint,
  accept,
  structures,
  wave,
  ground_component,
  // of a structure
  structure,
  name,
  damping,
  initial_displacement,
  initial_node_displacements,
  initial_velocity,
  forces,
  delay,
  face,
  // of a link
  link,
  between,
  within,
  left,
  right,
  floors,
  level_within,
  gap,
  preload,
  seat,
  link_name,
  points,
  friction,
  sliding_velocity,
  reduced_mass,
  law,
  // of a device
  device,
  device_name,
  bar,
  device_law,
  damper,
  axis
};

/// Invalid model. The text states the error and the remedy; a reader of inputs finds the location in its file from the
/// option.
class ModelError : public std::invalid_argument {
 public:
  ModelError(ModelOption option, const std::string& text) : std::invalid_argument(text), option_(option) {}
  /// An option of the structure with this number.
  ModelError(ModelOption option, int structure, const std::string& text)
      : std::invalid_argument(text), option_(option), structure_(structure) {}
  /// Marks the option as not allowed here.
  ModelError as_idle() const {
    ModelError copy = *this;
    copy.is_idle_ = true;
    return copy;
  }
  /// Sets the item of the option, from 0.
  ModelError of(int item) const {
    ModelError copy = *this;
    copy.item_ = item;
    return copy;
  }
  /// Sets the axis of the ground motion, 0 for x.
  ModelError along(int axis) const {
    ModelError copy = *this;
    copy.axis_ = axis;
    return copy;
  }

  ModelOption option() const noexcept { return option_; }  ///< the invalid option
  int structure() const noexcept { return structure_; }    ///< -1: none, or not in the model yet
  int axis() const noexcept { return axis_; }              ///< of a ground motion, 0 for x
  int item() const noexcept { return item_; }              ///< index of the item of an option, from 0
  bool is_idle() const noexcept { return is_idle_; }       ///< true if the option is not allowed here

 private:
  ModelOption option_;
  int structure_ = -1, axis_ = 0, item_ = 0;
  bool is_idle_ = false;
};

}  // namespace pounding
