#pragma once
#include <random>
#include <dmp/core/vector.hpp>

namespace test {

/// Vectors whose components lie between -size and size; always the same ones.
class RandomVectors {
 public:
  [[nodiscard]] dmp::Vector<3> vector(double size) { return size * dmp::Vector<3>(number(), number(), number()); }

 private:
  double number() { return static_cast<double>(generator_()) / 2147483648.0 - 1.0; }
  std::mt19937 generator_{7};
};

}  // namespace test
