// Prints data/self_test.json with the figures of this machine's first CPU device, one pixel per work-item. script/update-self-test
// runs it after a kernel's bits have changed on purpose.
#include "doctor/self_test.h"

#include <cstdio>

#include "gloam/error.h"
#include "technique/data_files.h"

namespace gloam::doctor {
namespace {

int print_table() {
  Json table = Json::parse(data_files().at("self_test.json"));
  Device device("Portable Computing Language");
  const std::vector<SelfTest> tests = self_tests(table.dump());
  std::printf("{\n  \"measured\": %s,\n  \"tests\": [\n", table.at("measured").dump().c_str());
  for (size_t i = 0; i < tests.size(); ++i) {
    SelfTest test = tests[i];
    test.options.lanes = 1;
    table["tests"][i]["expected"] = figures_of(test, device);
    std::printf("    %s%s\n", table["tests"][i].dump().c_str(), i + 1 < tests.size() ? "," : "");
  }
  std::printf("  ]\n}\n");
  return 0;
}

}  // namespace
}  // namespace gloam::doctor

int main() try { return gloam::doctor::print_table(); } catch (const gloam::Error& error) {
  std::fprintf(stderr, "self_test_table: %s\n", error.what());
  return 1;
}
