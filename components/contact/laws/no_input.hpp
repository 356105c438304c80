// The input of laws that need nothing but their parameters.
#pragma once

namespace sprekk::contact {

/// Nothing: the law follows from its parameters.
struct NoInput {};

}  // namespace sprekk::contact
