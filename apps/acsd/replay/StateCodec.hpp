#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// JSON of the content of a store.
[[nodiscard]] std::string EncodeState(const Planning::StoredState& state);

/// Reads what EncodeState wrote. Accepts any text.
[[nodiscard]] Core::Result<Planning::StoredState> DecodeState(std::string_view text);

/// JSON of a batch, in short: what changed to what. The same for equal batches only.
[[nodiscard]] std::string EncodeBatch(const Planning::StoreBatch& batch);

/// The plan of all its changes; empty: of several plans, or of none.
[[nodiscard]] std::string FindPlanID(const Planning::StoreBatch& batch);

} // namespace ACS::Acsd
