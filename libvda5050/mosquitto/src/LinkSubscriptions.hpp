#pragma once

#include <acs/vda5050/IMqttLink.hpp>

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// The subscriptions of a link, and which of them the broker has confirmed on the present connection. The link is up when those
/// that were there when the connection was established are confirmed. Pure.
class LinkSubscriptions final
{
public:
    /// Subscriptions that wait for an answer at a time. A broker that stores each of them in a cluster may need more than a second
    /// for one, during which it answers nothing else; all at once would take longer than the keep-alive permits.
    static constexpr std::size_t MAX_UNCONFIRMED = 4;

    struct Request
    {
        MqttSubscription subscription;
        bool bLater = false; ///< The link is up without it.
    };

    /// Of one that was answered.
    struct Answered
    {
        std::string filter;
        bool bLater = false;
    };

private:
    std::vector<MqttSubscription> _subscriptions;
    std::deque<Request> _waiting;         ///< Not sent yet, later ones last.
    std::map<int, Answered> _unconfirmed; ///< By the id of their message.
    std::string _refusedFilter;           ///< The reason why the connection ends.

public:
    /// Replaces one with the same filter. bConnected: it is to be sent on the present connection.
    void Add(const MqttSubscription& subscription, bool bConnected);
    void Remove(const std::string& topicFilter);

    /// An attempt to connect begins.
    void OnAttempt();

    /// The connection is established: all are to be sent.
    void OnConnected();

    /// The next one to be sent now; nothing while MAX_UNCONFIRMED are not answered, or after a refusal.
    [[nodiscard]] std::optional<Request> TakeNextOrNull();

    void OnSent(const Request& request, int messageID);

    /// Nothing if the message is of no subscription.
    [[nodiscard]] std::optional<Answered> OnAnsweredOrNull(int messageID);

    /// One that the link needs was refused or could not be sent: the first one is kept.
    void Refuse(const std::string& filter);

    /// Empty: none that the link needs was refused.
    [[nodiscard]] const std::string& GetRefused() const noexcept;

    /// Whether all that the link needs are confirmed.
    [[nodiscard]] bool IsConfirmed() const;
};

} // namespace ACS::VDA5050
