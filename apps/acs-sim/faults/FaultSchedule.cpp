#include "faults/FaultSchedule.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>
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
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(times.data(), times.data() + times.size(), count);
    const bool bNumber = error == std::errc() && end == times.data() + times.size();
    return bNumber && count > 0 && count <= MOST_TIMES ? std::optional(FaultOrder{*fault, count}) : std::nullopt;
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
