#pragma once

#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The last orders that ended for the master before the vehicle had shown them: a message of them may come late, from a queue.
class WithdrawnOrders
{
public:
    /// What became of an order that reappeared.
    enum class EReappearance : std::uint8_t
    {
        Running,
        Ended,
    };

private:
    struct WithdrawnOrder
    {
        std::string orderID;
        std::uint32_t orderUpdateID = 0;    ///< Of the message; of one before it the vehicle has shown the end.
        std::vector<std::string> actionIDs; ///< Sorted.
        bool bRejected = false;             ///< Rejected or never shown; otherwise cancelled.
    };

    std::vector<WithdrawnOrder> _orders;

public:
    /// The message is the one that may come late; null if none was sent.
    void Add(std::string orderID, const OrderMessage* messageOrNull, bool bRejected);
    void Remove(std::string_view orderID);
    /// Removes the order of the state. Nullopt: it is not one of these, or was cancelled as soon as it came.
    [[nodiscard]] std::optional<EReappearance> TakeReappearedOrNull(const StateMessage& state);

private:
    [[nodiscard]] static bool IsRunning(const WithdrawnOrder& order, const StateMessage& state);
};

} // namespace ACS::VDA5050
