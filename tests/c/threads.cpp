// Several threads share laws, follow separate impacts, and make separate errors; each obtains the results of a single
// thread, and its own texts.
#include <pounding.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr int threads = 8, rounds = 40;

// The speed after an impact, or after a time limit if no force pushes back.
double bounce(const pnd_law* law, double speed) {
  pnd_contact contact{};
  pnd_response r{};
  double d = 0, v = speed;
  pnd_touch(law, speed, &contact);
  for (int n = 0; n < 1000 && contact.touching != 0; ++n) {
    pnd_respond(law, &contact, d, v, &r);
    v -= 1e-4 * r.force / 6e4;
    d += 1e-4 * v;
    pnd_accept(law, d, v, &contact);
  }
  return v;
}

// Every law in turn, found in the lists and created with its typical values.
std::vector<pnd_law*> typical_laws() {
  std::vector<pnd_law*> laws;
  for (size_t i = 0; i < pnd_law_count(); ++i) {
    pnd_law_info info{};
    pnd_describe_law(i, &info);
    std::vector<pnd_value> values;
    for (size_t k = 0; k < info.parameters; ++k) {
      pnd_parameter_info p{};
      pnd_describe_parameter(i, k, &p);
      if (p.need == PND_REQUIRED || std::string(p.name) == "restitution") values.push_back({p.name, p.typical});
    }
    pnd_law* law = nullptr;
    if (pnd_create(info.name, info.formulas > 0 ? "exact" : "", values.data(), values.size(), &law) != PND_OK)
      std::puts(pnd_error_text());
    laws.push_back(law);
  }
  return laws;
}

std::vector<double> answers(const std::vector<pnd_law*>& laws) {
  std::vector<double> list;
  for (const pnd_law* law : laws) {
    pnd_free_impact impact{};
    pnd_collide(law, 6e4, 0.8, &impact);
    list.push_back(impact.restitution);
    list.push_back(bounce(law, 0.8));
  }
  return list;
}

}  // namespace

int main() {
  const std::vector<pnd_law*> shared = typical_laws();
  const std::vector<double> expected = answers(shared);
  std::array<int, threads> wrong{};
  std::vector<std::thread> team;
  for (int t = 0; t < threads; ++t)
    team.emplace_back([&, t] {
      const std::string name = "law of thread " + std::to_string(t);
      for (int round = 0; round < rounds; ++round) {
        size_t index = 0;
        pnd_find_law(name.c_str(), &index);
        wrong[t] += round == 0 && answers(shared) != expected;
        const std::vector<pnd_law*> own = typical_laws();
        const size_t law = static_cast<size_t>(round) % own.size();
        wrong[t] += bounce(own[law], 0.8) != expected[2 * law + 1];
        for (pnd_law* each : own) pnd_destroy(each);
        wrong[t] += std::string(pnd_error_text()).find("\"" + name + "\"") == std::string::npos;
      }
    });
  for (std::thread& each : team) each.join();
  for (pnd_law* law : shared) pnd_destroy(law);
  int all = 0;
  for (const int count : wrong) all += count;
  std::printf("%d answers differ\n", all);
  return all == 0 && std::isfinite(expected.back()) ? 0 : 1;
}
