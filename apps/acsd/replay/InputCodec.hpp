#pragma once

#include "replay/CoreInput.hpp"
#include "replay/CoreRecord.hpp"
#include <acs/core/Result.hpp>

namespace ACS::Acsd
{

/// The record of an input, without its time and depth.
[[nodiscard]] CoreRecord EncodeInput(const CoreInput& input);

/// Reads what EncodeInput wrote. A JobCheckChanged has no check. Accepts any record.
[[nodiscard]] Core::Result<CoreInput> DecodeInput(const CoreRecord& record);

} // namespace ACS::Acsd
