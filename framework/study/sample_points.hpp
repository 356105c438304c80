// Points that fill a unit cube evenly, for samples of uncertain values.
#pragma once

#include <cstdint>
#include <vector>

namespace sprekk {

/// Points with coordinates strictly between 0 and 1. They follow from the seed alone, on every machine.
using SamplePoints = std::vector<std::vector<double>>;

/// Independent random points.
SamplePoints random_points(int count, int dimensions, std::uint64_t seed);

/// Each coordinate has one point in each of `count` equal intervals, in random order (McKay, Beckman and Conover 1979,
/// Technometrics 21, 239).
SamplePoints latin_hypercube(int count, int dimensions, std::uint64_t seed);

/// The first points of Sobol's sequence, with the direction numbers of Joe and Kuo (2008, SIAM J. Sci. Comput. 30,
/// 2635), shifted digit by digit by random numbers of the seed: of 2^k points, each coordinate has one in each of 2^k
/// equal intervals. Throws std::logic_error beyond `most_sobol_dimensions`.
SamplePoints sobol_points(int count, int dimensions, std::uint64_t seed);
constexpr int most_sobol_dimensions = 10;

/// The number below which a standard normal one lies with probability p, which is strictly between 0 and 1.
double normal_quantile(double p);

}  // namespace sprekk
