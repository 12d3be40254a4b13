#include "store/StoreSummary.hpp"

#include <acs/plan/PlanTransitions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace ACS::Acsd
{

namespace
{

/// "no alarms", "1 alarm", "2 alarms"
std::string CountOf(std::size_t count, std::string_view one, std::string_view many)
{
    return count == 0 ? fmt::format("no {}", many) : fmt::format("{} {}", count, count == 1 ? one : many);
}

} // namespace

std::string MakeStoreSummary(const Planning::StoreOrigin& origin, const Planning::StoredState& state)
{
    const Planning::ETscState tsc = state.tscState.value_or(Planning::ETscState::Auto);
    if (origin.bNew)
    {
        return fmt::format(
            "new, schema {}{}",
            origin.version,
            tsc == Planning::ETscState::Auto ? "" : ", TSC Paused until an operator resumes it (tsc.new_store)");
    }
    const auto ended = static_cast<std::size_t>(
        std::ranges::count_if(state.plans, [](const auto& record) { return IsFinal(record.progress.state); }));
    std::string text = fmt::format("schema {}", origin.version);
    if (origin.foundVersion != origin.version)
    {
        text += fmt::format(" migrated from {}", origin.foundVersion);
    }
    text += fmt::format(
        ", {} resumed, {}, {} not acknowledged, {}",
        CountOf(state.plans.size() - ended, "open plan", "open plans"),
        CountOf(ended, "ended plan", "ended plans"),
        CountOf(state.outbox.size(), "report", "reports"),
        CountOf(state.alarms.size(), "alarm", "alarms"));
    if (!state.robotsInMaintenance.empty())
    {
        text += fmt::format(", in maintenance {}", fmt::join(state.robotsInMaintenance, " "));
    }
    if (tsc != Planning::ETscState::Auto)
    {
        text += fmt::format(", TSC {}", GetText(tsc));
    }
    if (!state.holdReason.empty())
    {
        text += "; no robot is moved until the TSC is resumed: " + state.holdReason;
    }
    if (origin.bRescued)
    {
        text += "; restored from the copy that was made when the database was removed while it was open";
    }
    if (origin.bMigrated)
    {
        text += "; migrated from the former layout; its files are kept with .former in their names";
    }
    return text;
}

} // namespace ACS::Acsd
