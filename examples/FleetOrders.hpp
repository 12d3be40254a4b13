#pragma once

#include "JournalFile.hpp"
#include <acs/core/Result.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

/// A line of commands or of the journal: what, for whom, and the rest.
struct FleetLine
{
    std::string verb;
    std::string vehicle; ///< MANUFACTURER/SERIALNUMBER
    std::string text;

    [[nodiscard]] static FleetLine Split(const std::string& line)
    {
        const std::size_t first = std::min(line.find(' '), line.size());
        const std::size_t second = std::min(line.find(' ', first + 1), line.size());
        const auto cut = [&line](std::size_t begin, std::size_t end) {
            return begin < end ? line.substr(begin, end - begin) : std::string();
        };
        return {line.substr(0, first), cut(first + 1, second), cut(second + 1, line.size())};
    }
};

/// One order of the journal.
struct FleetOrder
{
    ACS::VDA5050::OrderBuilder route;
    ACS::VDA5050::OrderRecord record; ///< What was sent of it, and accepted.
    std::size_t reached = 0;          ///< Nodes.
    bool bGiven = false;              ///< The session has it.
    bool bCancelAsked = false;
};

/// The orders of all vehicles, each vehicle's in a queue of which the first one runs. What changes is in the journal
/// before it is true here, so that a program that is killed finds all again. The Try functions return false where the disk
/// takes no more: then onBroken has been called, and nothing may be sent either.
class FleetOrders
{
public:
    enum class ETaking : std::uint8_t
    {
        Taken,
        Known,  ///< One with this id was taken before.
        Broken, ///< onBroken has been called.
    };

    struct Taking
    {
        std::string orderID;
        ETaking result = ETaking::Taken;
    };

private:
    struct Queue
    {
        std::deque<FleetOrder> orders;
        std::set<std::string> orderIDs; ///< Of all that were ever taken.
    };

    JournalFile _journal;
    ACS::VDA5050::Vda5050Codec _codec;
    std::map<std::string, Queue> _queues; ///< By the vehicle's name.

public:
    std::function<void(const std::string& reason)> onBroken;

    /// False where the journal cannot be read and written (see errno).
    [[nodiscard]] bool TryOpen(const std::string& path)
    {
        const std::optional<std::vector<std::string>> lines = _journal.OpenOrNull(path);
        if (lines.has_value())
        {
            std::ranges::for_each(*lines, [this](const std::string& line) { Replay(FleetLine::Split(line)); });
        }
        return lines.has_value();
    }

    [[nodiscard]] std::vector<std::string> ListVehicles() const
    {
        std::vector<std::string> names;
        for (const auto& [name, queue] : _queues)
        {
            names.push_back(name);
        }
        return names;
    }

    [[nodiscard]] bool IsEmpty() const
    {
        return std::ranges::all_of(_queues, [](const auto& entry) { return entry.second.orders.empty(); });
    }

    /// The order that runs, or is the next to.
    [[nodiscard]] FleetOrder* GetFirstOrNull(const std::string& vehicle)
    {
        std::deque<FleetOrder>& orders = _queues[vehicle].orders;
        return orders.empty() ? nullptr : &orders.front();
    }

    /// The text is an order message with its whole route. An error where it is none.
    [[nodiscard]] ACS::Core::Result<Taking> Take(const std::string& vehicle, const std::string& text)
    {
        ACS::Core::Result<FleetOrder> order = MakeOrder(text);
        if (!order)
        {
            return tl::unexpected(std::move(order.error()));
        }
        const std::string orderID = order->route.GetOrderID();
        if (_queues[vehicle].orderIDs.contains(orderID))
        {
            return Taking{orderID, ETaking::Known};
        }
        if (!TryWrite("order", vehicle, text))
        {
            return Taking{orderID, ETaking::Broken};
        }
        Insert(vehicle, std::move(*order));
        return Taking{orderID, ETaking::Taken};
    }

    /// The next message of the first order, which releases this number of nodes: see record.
    [[nodiscard]] bool TryRelease(const std::string& vehicle, std::size_t nodes)
    {
        return TryWrite("release", vehicle, std::to_string(nodes)) && TryMakeMessage(*GetFirstOrNull(vehicle), nodes);
    }

    [[nodiscard]] bool TryAccept(const std::string& vehicle, std::uint32_t orderUpdateID)
    {
        const bool bWritten = TryWrite("accepted", vehicle, std::to_string(orderUpdateID));
        if (bWritten)
        {
            GetFirstOrNull(vehicle)->record.acceptedUpdateID = orderUpdateID;
        }
        return bWritten;
    }

    /// The vehicle has rejected this update: it is not resumed, and the next one begins where it did.
    [[nodiscard]] bool TryReject(const std::string& vehicle, std::uint32_t orderUpdateID)
    {
        const bool bWritten = TryWrite("rejected", vehicle, std::to_string(orderUpdateID));
        if (bWritten)
        {
            RemoveUpdate(*GetFirstOrNull(vehicle), orderUpdateID);
        }
        return bWritten;
    }

    [[nodiscard]] bool TryAskCancel(const std::string& vehicle)
    {
        const bool bWritten = TryWrite("cancel", vehicle, {});
        if (bWritten)
        {
            GetFirstOrNull(vehicle)->bCancelAsked = true;
        }
        return bWritten;
    }

    /// The cancel has failed: the order stays, and a new start does not cancel it either.
    [[nodiscard]] bool TryForgetCancel(const std::string& vehicle)
    {
        const bool bWritten = TryWrite("kept", vehicle, {});
        if (bWritten)
        {
            GetFirstOrNull(vehicle)->bCancelAsked = false;
        }
        return bWritten;
    }

    [[nodiscard]] bool TryEnd(const std::string& vehicle)
    {
        const bool bWritten = TryWrite("ended", vehicle, GetFirstOrNull(vehicle)->route.GetOrderID());
        if (bWritten)
        {
            _queues[vehicle].orders.pop_front();
        }
        return bWritten;
    }

private:
    [[nodiscard]] bool TryWrite(std::string_view verb, const std::string& vehicle, const std::string& text)
    {
        const bool bWritten = _journal.TryAppend(fmt::format("{} {} {}", verb, vehicle, text));
        if (!bWritten)
        {
            onBroken(std::generic_category().message(errno));
        }
        return bWritten;
    }

    [[nodiscard]] ACS::Core::Result<FleetOrder> MakeOrder(const std::string& text)
    {
        return _codec.Decode<ACS::VDA5050::OrderMessage>(text).and_then([](ACS::VDA5050::OrderMessage order) {
            return ACS::VDA5050::OrderBuilder::Create(order.orderID, std::move(order.nodes), std::move(order.edges))
                .map([](ACS::VDA5050::OrderBuilder route) {
                    return FleetOrder{std::move(route), {}, 0, false, false};
                });
        });
    }

    void Insert(const std::string& vehicle, FleetOrder order)
    {
        Queue& queue = _queues[vehicle];
        queue.orderIDs.insert(order.route.GetOrderID());
        queue.orders.push_back(std::move(order));
    }

    /// The builder makes the same messages from the same numbers, so the numbers are all that the journal needs.
    [[nodiscard]] static bool TryMakeMessage(FleetOrder& order, std::size_t nodes)
    {
        ACS::Core::Result<ACS::VDA5050::OrderMessage> message =
            order.record.messages.empty() ? order.route.MakeOrder(nodes) : order.route.MakeUpdate(nodes);
        if (message)
        {
            order.record.messages.push_back(std::move(*message));
        }
        return message.has_value();
    }

    static void RemoveUpdate(FleetOrder& order, std::uint32_t orderUpdateID)
    {
        std::vector<ACS::VDA5050::OrderMessage>& messages = order.record.messages;
        if (messages.size() > 1 && messages.back().orderUpdateID == orderUpdateID)
        {
            messages.pop_back();
            order.route.WithdrawUpdate();
        }
    }

    void Replay(const FleetLine& line)
    {
        FleetOrder* const firstOrNull = GetFirstOrNull(line.vehicle);
        std::size_t count = 0;
        std::from_chars(line.text.data(), line.text.data() + line.text.size(), count);
        if (line.verb == "order")
        {
            if (ACS::Core::Result<FleetOrder> order = MakeOrder(line.text))
            {
                Insert(line.vehicle, std::move(*order));
            }
        }
        else if (firstOrNull == nullptr)
        {
            return;
        }
        else if (line.verb == "release")
        {
            std::ignore = TryMakeMessage(*firstOrNull, count);
        }
        else if (line.verb == "accepted")
        {
            firstOrNull->record.acceptedUpdateID = static_cast<std::uint32_t>(count);
        }
        else if (line.verb == "rejected")
        {
            RemoveUpdate(*firstOrNull, static_cast<std::uint32_t>(count));
        }
        else if (line.verb == "cancel")
        {
            firstOrNull->bCancelAsked = true;
        }
        else if (line.verb == "kept")
        {
            firstOrNull->bCancelAsked = false;
        }
        else if (line.verb == "ended")
        {
            _queues[line.vehicle].orders.pop_front();
        }
    }
};
