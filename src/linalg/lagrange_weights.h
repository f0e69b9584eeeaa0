// Polynomials through given points, in Lagrange's form.
#pragma once

#include <cstddef>

namespace pintle {

/// Fills out[first] .. out[end - 1] with the weights, at x, of the values at the nodes with these indices. Nodes, out: anything
/// with [].
template <class Nodes, class Out>
void lagrange_weights(const Nodes& nodes, std::size_t first, std::size_t end, double x, Out& out) {
  for (std::size_t i = first; i < end; ++i) {
    out[i] = 1;
    for (std::size_t j = first; j < end; ++j)
      if (i != j) out[i] *= (x - nodes[j]) / (nodes[i] - nodes[j]);
  }
}

}  // namespace pintle
