#include <pounding/results/checkpoint.hpp>

#include <pounding/core/checksum.hpp>

namespace pounding {

std::string checksum_of(const Checkpoint& checkpoint, const std::string& model_yaml, const std::string& resolved_yaml) {
  Checksum checksum;
  for (const std::string* text : {&model_yaml, &resolved_yaml, &checkpoint.model_file, &checkpoint.ground})
    checksum.add(*text);
  for (const std::string& option : checkpoint.options) checksum.add(option);
  checksum.add(checkpoint.state);
  return checksum.text();
}

}  // namespace pounding
