#include "measure/google_benchmark.h"

#include <chrono>
#include <cmath>
#include <numeric>

#include "base/statistics.h"
#include "measure/timing.h"

namespace gloam::bench {
namespace {

using Json = nlohmann::ordered_json;

/// "courtyard/gtao/medium/half/480x270", with the effect where it is not ambient occlusion. Spaces would end a filter of such tools.
std::string benchmark_name_of(const Json& row) {
  std::string name = row.at("scene").get<std::string>() + "/" + row.at("technique").get<std::string>() + "/" +
                     row.at("preset").get<std::string>();
  if (row.at("variant") != "") name += "/" + row.at("variant").get<std::string>();
  if (row.at("effect") != "ao") name += "/" + row.at("effect").get<std::string>();
  name += fmt::format("/{}x{}", row.at("width").get<int>(), row.at("height").get<int>());
  for (char& c : name) {
    if (c == ' ' || c == ',') c = '_';
  }
  return name;
}

double mean(const Series& values) { return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size()); }

/// Of a sample, as Google Benchmark has it; 0 for one round.
double deviation(const Series& values) {
  if (values.size() < 2) return 0;
  const double middle = mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / double(values.size() - 1));
}

double variation(const Series& values) { return deviation(values) / mean(values); }

struct Aggregate {
  const char *name, *unit;
  double (*of)(const Series&);
};
double median_of(const Series& values) { return median(values); }
constexpr Aggregate aggregates[] = {{"mean", "time", mean},
                                    {"median", "time", median_of},
                                    {"stddev", "time", deviation},
                                    {"cv", "percentage", variation}};

/// What is the same for all entries of a row. Counters are numbers beside the times; what a row lacks is left out.
void add_counters(Json& entry, const Json& row) {
  for (const char* counter : {"rmse_to_truth", "bias", "ratio_to_hbao_plus", "ratio_to_gather_floor"}) {
    if (row.contains(counter) && row.at(counter).is_number()) entry[counter] = row.at(counter);
  }
}

Json entry_of(const std::string& name, int family, size_t rounds) {
  return {{"name", name},     {"family_index", family},  {"per_family_instance_index", 0},
          {"run_name", name}, {"run_type", "iteration"}, {"repetitions", rounds},
          {"threads", 1}};
}

void add_row(Json& benchmarks, const Json& row, int family) {
  const Series real = row.at("ms").at("rounds");
  // Where the cores' time is not known, as of a GPU, readers still expect a number.
  const bool has_cpu = row.contains("cpu_ms") && row.at("cpu_ms").is_object();
  const Series cpu = has_cpu ? row.at("cpu_ms").at("rounds").get<Series>() : real;
  const std::string name = benchmark_name_of(row);
  for (size_t i = 0; i < real.size(); ++i) {
    Json entry = entry_of(name, family, real.size());
    entry.update(Json{
        {"repetition_index", i}, {"iterations", 1}, {"real_time", real[i]}, {"cpu_time", cpu[i]}, {"time_unit", "ms"}});
    add_counters(entry, row);
    benchmarks.push_back(entry);
  }
  if (real.size() < 2) return;
  for (const Aggregate& aggregate : aggregates) {
    Json entry = entry_of(name, family, real.size());
    entry["name"] = fmt::format("{}_{}", name, aggregate.name);
    entry["run_type"] = "aggregate";
    entry.update(Json{{"aggregate_name", aggregate.name},
                      {"aggregate_unit", aggregate.unit},
                      {"iterations", real.size()},
                      {"real_time", aggregate.of(real)},
                      {"cpu_time", aggregate.of(cpu)},
                      {"time_unit", "ms"}});
    if (aggregate.of == median_of) add_counters(entry, row);
    benchmarks.push_back(entry);
  }
}

std::string now_as_text() {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  const std::time_t time = std::chrono::system_clock::to_time_t(now);
  std::tm parts{};
  gmtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S+00:00", &parts);
  return text;
}

}  // namespace

Json google_benchmark_of(const Json& document) {
  Json benchmarks = Json::array();
  int family = 0;
  for (const Json& row : document.at("results")) add_row(benchmarks, row, family++);
  const Json context = {{"date", now_as_text()},
                        {"executable", "gloam"},
                        {"num_cpus", document.at("cores")},
                        {"mhz_per_cpu", 0},
                        {"cpu_scaling_enabled", false},
                        {"caches", Json::array()},
                        {"load_avg", Json::array()},
                        {"library_build_type", "release"},
                        {"device", document.at("device")},
                        {"driver", document.at("driver")},
                        {"cpu", document.at("cpu")},
                        {"gloam", document.at("gloam")},
                        {"commit", document.at("commit")}};
  return {{"context", context}, {"benchmarks", benchmarks}};
}

}  // namespace gloam::bench
