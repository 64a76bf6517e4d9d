// A file of strong motion, whose format the reader detects. Options vary with the size.

#include <cmath>

#include <pounding/ground/record.hpp>
#include "fuzz.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pounding;
  static const RecordOptions options[] = {{},
                                          {.units = "g"},
                                          {.units = "cm/s^2", .channel = "1"},
                                          {.units = "g", .step = 0.01},
                                          {.units = "cm", .displacement = true}};
  fuzz::refusing([&] {
    const Record record = read_record_text(fuzz::text_of(data, size), "record.txt", options[size % std::size(options)]);
    const Samples& samples = record.samples;
    fuzz::require(samples.times.size() > 1 && samples.times.size() == samples.accelerations.size(),
                  "a record has two samples or more");
    for (std::size_t i = 0; i < samples.times.size(); ++i)
      fuzz::require(std::isfinite(samples.times[i]) && std::isfinite(samples.accelerations[i]) &&
                        (i == 0 || samples.times[i] > samples.times[i - 1]),
                    "samples are finite, and their times ascend");
    fuzz::require(!record.summary().empty(), "a record has a summary");
  });
  return 0;
}
