#pragma once
/// Random numbers by seed and place: the same ones on every machine, in any order, on any number of threads.

#include <cstdint>
#include <initializer_list>

namespace morsel::tools {

/// The use that random numbers are drawn for.
enum class RandomUse : std::uint8_t {
  normal_noise,
  isotropic_noise,
  decimation,
  placement,
  random_points,
  spread_points,
  bootstrap
};

/// A sequence of random numbers that is named by a seed, a use and a place (which trial, which vertex …), so
/// that each place has its own numbers whatever else is drawn. SplitMix64 (Steele, Lea, Flood 2014, "Fast
/// splittable pseudorandom number generators") started at a hash of the three. A value type of 8 bytes.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, RandomUse use, std::initializer_list<std::uint64_t> place);

  std::uint64_t next();
  /// In the open interval (0, 1), in steps of 2⁻⁵².
  double uniform();
  /// Of mean 0 and standard deviation 1, by the ratio of uniforms (Kinderman, Monahan 1977): the logarithm,
  /// the one function whose last bit differs between machines, only decides and enters no value.
  double normal();
  /// 0 … count − 1, each as likely; count ≥ 1.
  std::uint64_t below(std::uint64_t count);

 private:
  std::uint64_t state_;
};

}  // namespace morsel::tools
