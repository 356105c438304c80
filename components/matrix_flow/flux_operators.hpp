// The names of flux operators in this folder.
#pragma once

#include "components/capabilities/flux_discretization.hpp"

namespace sprekk::matrix_flow {

using sprekk::FacePressureOperators;
using sprekk::FlowCondition;
using sprekk::FluxOperators;

}  // namespace sprekk::matrix_flow
