#pragma once

#include "OrderErrors.hpp"
#include <acs/vda5050/OrderValidator.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050
{

/// Maximum number of reported violations: more do not help, and each one repeats the ids of the order.
inline constexpr std::size_t MAXIMUM_VIOLATIONS = 16;

/// Collects the first violations of one order, all of one errorType.
class OrderFindings
{
    const OrderMessage& _order;
    std::string_view _errorType;
    std::vector<OrderViolation> _violations;
    OrderViolation _surplus; ///< Beyond the maximum.

public:
    /// The order outlives the findings; so does the text of the type.
    OrderFindings(const OrderMessage& order, std::string_view errorType)
        : _order(order),
          _errorType(errorType)
    {
    }

    /// The error as it will be reported, for further references; valid until the next call.
    VehicleError& Add(std::string rule)
    {
        OrderViolation violation = MakeOrderViolation(_order, _errorType, std::move(rule));
        if (_violations.size() < MAXIMUM_VIOLATIONS)
        {
            return _violations.emplace_back(std::move(violation)).error;
        }
        _surplus = std::move(violation);
        return _surplus.error;
    }

    /// With the value that breaks the rule, and a reference to it.
    void Add(const std::string& rule, std::string_view key, const std::string& value)
    {
        AddReference(Add(rule + ": " + value), key, value);
    }

    [[nodiscard]] const OrderMessage& GetOrder() const noexcept
    {
        return _order;
    }

    [[nodiscard]] std::vector<OrderViolation> Take()
    {
        return std::move(_violations);
    }
};

} // namespace ACS::VDA5050
