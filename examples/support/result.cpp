#include "support/result.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <dmp/core/require.hpp>

namespace example {

namespace {

std::string number(double value) { return std::isfinite(value) ? dmp::to_text(value) : "null"; }

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

bool within(const Result::Error& error) { return std::fabs(error.value) <= error.bound; }

}  // namespace

void Result::error(std::string_view name, double value, double bound, std::string_view reference) {
  errors.push_back({std::string(name), value, bound, std::string(reference)});
}

bool Result::holds() const {
  for (const Error& error : errors)
    if (!within(error)) return false;
  return !errors.empty();
}

int Result::print(const dmp::io::OutputFolder& folder) const {
  std::string json = "{\"example\": " + quoted(example) + ", \"case\": " + quoted(test_case) + ", \"resolution\": " + quoted(resolution) +
                     ", \"particles\": " + std::to_string(particles) + ", \"steps\": " + std::to_string(steps) + ", \"errors\": {";
  for (const Error& error : errors) {
    std::printf("%-4s %-52s %12.5g  bound %-10.5g (%s)\n", within(error) ? "ok" : "BAD", error.name.c_str(), error.value, error.bound,
                error.reference.c_str());
    json += (&error == errors.data() ? "" : ", ") + quoted(error.name) + ": {\"value\": " + number(error.value) + ", \"bound\": " +
            number(error.bound) + ", \"reference\": " + quoted(error.reference) + "}";
  }
  json += "}, \"holds\": " + std::string(holds() ? "true" : "false") + ", \"wall_seconds\": " + number(wall_seconds) +
          ", \"processor_seconds\": " + number(processor_seconds) +
          ", \"particle_steps_per_second\": " + number(wall_seconds > 0.0 ? particle_steps / wall_seconds : 0.0) +
          ", \"bytes_per_particle\": " + number(bytes_per_particle) + ", \"step_bound_by\": " + quoted(step_bound_by) + "}";
  std::printf("result: %s\n", json.c_str());
  std::ofstream file(folder / "result.json");
  file << json << '\n';
  file.close();
  if (!file) throw std::runtime_error("cannot write result.json");
  return holds() ? 0 : 1;
}

int guarded(const char* name, int (*function)(const Options&), const Options& options) {
  try {
    return function(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 2;
  }
}

}  // namespace example
