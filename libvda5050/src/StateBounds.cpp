#include "StateBounds.hpp"

#include "StateRoom.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ACS::VDA5050
{

namespace
{

void DropNonFinite(std::optional<double>& number)
{
    if (number.has_value() && !std::isfinite(*number))
    {
        number.reset();
    }
}

/// As stated, and no more than is read.
std::size_t GetMost(std::optional<std::uint32_t> limitOrNull)
{
    return limitOrNull.value_or(0) == 0 ? StateRoom::ARRAY : std::min<std::size_t>(*limitOrNull, StateRoom::ARRAY);
}

bool IsTooLong(std::size_t size, std::optional<std::uint32_t> limitOrNull)
{
    return size > GetMost(limitOrNull);
}

template <typename TItem>
void Cut(std::vector<TItem>& items, std::optional<std::uint32_t> limitOrNull)
{
    if (IsTooLong(items.size(), limitOrNull))
    {
        items.resize(GetMost(limitOrNull));
    }
}

void CutErrors(std::vector<VehicleError>& errors, std::optional<std::uint32_t> limitOrNull)
{
    while (IsTooLong(errors.size(), limitOrNull))
    {
        const auto firstWarning = std::ranges::find(errors, EErrorLevel::Warning, &VehicleError::errorLevel);
        errors.erase(firstWarning == errors.end() ? errors.begin() : firstWarning);
    }
}

} // namespace

void DropNonFinite(Velocity& velocity)
{
    DropNonFinite(velocity.vx);
    DropNonFinite(velocity.vy);
    DropNonFinite(velocity.omega);
}

void DropNonFinite(AgvPosition& position)
{
    DropNonFinite(position.localizationScore);
    DropNonFinite(position.deviationRange);
}

void DropNonFinite(BatteryState& battery)
{
    DropNonFinite(battery.batteryVoltage);
    DropNonFinite(battery.batteryHealth);
    DropNonFinite(battery.reach);
}

void DropNonFinite(Load& load)
{
    DropNonFinite(load.weight);
    if (load.boundingBoxReference.has_value())
    {
        BoundingBoxReference& box = *load.boundingBoxReference;
        DropNonFinite(box.theta);
        if (!std::isfinite(box.x) || !std::isfinite(box.y) || !std::isfinite(box.z))
        {
            load.boundingBoxReference.reset();
        }
    }
    if (load.loadDimensions.has_value())
    {
        LoadDimensions& dimensions = *load.loadDimensions;
        DropNonFinite(dimensions.height);
        if (!std::isfinite(dimensions.length) || !std::isfinite(dimensions.width))
        {
            load.loadDimensions.reset();
        }
    }
}

void FitState(StateMessage& state, const MaximumArrayLengths& limits)
{
    if (state.maps.has_value())
    {
        Cut(*state.maps, std::nullopt);
    }
    if (state.loads.has_value())
    {
        Cut(*state.loads, limits.stateLoads);
    }
    CutErrors(state.errors, limits.stateErrors);
    for (VehicleError& error : state.errors)
    {
        Cut(error.errorReferences, limits.errorReferences);
    }
    Cut(state.information, limits.stateInformation);
    for (Information& information : state.information)
    {
        Cut(information.infoReferences, limits.informationReferences);
    }
}

} // namespace ACS::VDA5050
