#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>

#include <string>

namespace ACS::Core
{

/// A random UUID (version 4) in its canonical lower-case form, for example for a transactionId. Its uniqueness
/// depends on the random source.
[[nodiscard]] ACS_API std::string MakeUUID(IRandom& random);

} // namespace ACS::Core
