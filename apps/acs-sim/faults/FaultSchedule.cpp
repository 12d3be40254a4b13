#include "faults/FaultSchedule.hpp"

#include <acs/core/ParseNumber.hpp>

#include <algorithm>
#include <utility>

namespace ACS::AcsSim
{

namespace
{

constexpr std::size_t MOST_TIMES = 1'000'000;

} // namespace

std::optional<FaultOrder> ReadFaultOrderOrNull(std::string_view text)
{
    const std::size_t equals = text.find('=');
    const std::optional<EFault> fault = ReadFaultOrNull(text.substr(0, equals));
    if (!fault.has_value())
    {
        return std::nullopt;
    }
    if (equals == std::string_view::npos)
    {
        return FaultOrder{*fault, 1};
    }
    const std::string_view times = text.substr(equals + 1);
    if (times == "always")
    {
        return FaultOrder{*fault, std::nullopt};
    }
    const std::size_t count = Core::ParseNumberOrNull<std::size_t>(times).value_or(0);
    return count > 0 && count <= MOST_TIMES ? std::optional(FaultOrder{*fault, count}) : std::nullopt;
}

FaultSchedule::FaultSchedule(std::vector<FaultOrder> orders)
    : _orders(std::move(orders))
{
}

std::optional<EFault> FaultSchedule::ExtractNextOrNull()
{
    for (std::size_t tried = 0; tried < _orders.size(); ++tried)
    {
        FaultOrder& order = _orders[_next];
        _next = (_next + 1) % _orders.size();
        if (order.count != std::size_t{0})
        {
            if (order.count.has_value())
            {
                --*order.count;
            }
            return order.fault;
        }
    }
    return std::nullopt;
}

bool FaultSchedule::HasCounted() const
{
    return std::ranges::any_of(_orders, [](const FaultOrder& order) { return order.count.value_or(0) > 0; });
}

} // namespace ACS::AcsSim
