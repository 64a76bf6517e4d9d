#include <pounding/run/same_model.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/checksum.hpp>
#include <pounding/core/error.hpp>
#include <pounding/model/ground_plan.hpp>

namespace pounding {
namespace {

// Something that was read, and a checksum of it.
struct Read {
  std::string name, checksum;
};

std::vector<Read> read_by(const Model& model) {
  const auto checksum_of = [](const auto&... parts) {
    Checksum checksum;
    (checksum.add(parts), ...);
    return checksum.text();
  };
  const std::string file = model.source_file.empty() ? "the model" : model.source_file;
  std::vector<Read> all{{file, checksum_of(model.source_text)}};
  for (const GroundMotion& motion : ground_plan(model).motions)
    if (const Samples* samples = motion.samples())
      all.push_back({fmt::format("{}: the record {}", file, motion.source()),
                     checksum_of(samples->times, samples->accelerations)});
  return all;
}

// Checksums of one process as a message, one a line.
std::vector<std::byte> message(const std::vector<Read>& all) {
  std::string text;
  for (const Read& each : all) text += each.checksum + "\n";
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  return {bytes, bytes + text.size()};
}

}  // namespace

void require_same_model(const petsc::Ranks& ranks, const Model& model) {
  if (ranks.size() == 1) return;
  std::vector<Read> mine = read_by(model);
  const std::vector<std::vector<std::byte>> messages = ranks.gather(message(mine));
  const std::vector<std::byte>& first = messages.front();
  std::vector<int> others;  // numbers of processes, from 1
  std::size_t same = first.size();
  for (std::size_t rank = 1; rank < messages.size(); ++rank) {
    if (messages[rank] == first) continue;
    others.push_back(static_cast<int>(rank) + 1);
    same = std::min<std::size_t>(same, std::ranges::mismatch(first, messages[rank]).in1 - first.begin());
  }
  if (others.empty()) return;
  // All checksums have one length; the first process names what differs first.
  const std::size_t number = same / (mine.front().checksum.size() + 1);
  ranks.on_root([&] {
    throw InputError(fmt::format(
        "{}: process{} {} of {} read{} another one than process 1; name a file that all of them see, and see alike",
        mine.at(std::min(number, mine.size() - 1)).name, others.size() > 1 ? "es" : "", fmt::join(others, ", "),
        ranks.size(), others.size() > 1 ? "" : "s"));
  });
}

}  // namespace pounding
