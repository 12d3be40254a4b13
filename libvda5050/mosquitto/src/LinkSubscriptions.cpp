#include "LinkSubscriptions.hpp"

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

void LinkSubscriptions::Add(const MqttSubscription& subscription, bool bConnected)
{
    Remove(subscription.topicFilter);
    _subscriptions.push_back(subscription);
    if (bConnected)
    {
        _waiting.push_back({subscription, true});
    }
}

void LinkSubscriptions::Remove(const std::string& topicFilter)
{
    std::erase_if(_subscriptions, [&topicFilter](const MqttSubscription& known) {
        return known.topicFilter == topicFilter;
    });
    std::erase_if(_waiting, [&topicFilter](const Request& waiting) {
        return waiting.subscription.topicFilter == topicFilter;
    });
}

void LinkSubscriptions::OnAttempt()
{
    _waiting.clear();
    _unconfirmed.clear();
    _refusedFilter.clear();
}

void LinkSubscriptions::OnConnected()
{
    _waiting.clear();
    for (const MqttSubscription& subscription : _subscriptions)
    {
        _waiting.push_back({subscription, false});
    }
}

std::optional<LinkSubscriptions::Request> LinkSubscriptions::TakeNextOrNull()
{
    if (_waiting.empty() || !_refusedFilter.empty() || _unconfirmed.size() >= MAX_UNCONFIRMED)
    {
        return std::nullopt;
    }
    std::optional<Request> next(std::move(_waiting.front()));
    _waiting.pop_front();
    return next;
}

void LinkSubscriptions::OnSent(const Request& request, int messageID)
{
    _unconfirmed[messageID] = {request.subscription.topicFilter, request.bLater};
}

std::optional<LinkSubscriptions::Answered> LinkSubscriptions::OnAnsweredOrNull(int messageID)
{
    auto answered = _unconfirmed.extract(messageID);
    return answered.empty() ? std::nullopt : std::optional(std::move(answered.mapped()));
}

void LinkSubscriptions::Refuse(const std::string& filter)
{
    if (_refusedFilter.empty())
    {
        _refusedFilter = filter;
    }
}

const std::string& LinkSubscriptions::GetRefused() const noexcept
{
    return _refusedFilter;
}

bool LinkSubscriptions::IsConfirmed() const
{
    const bool bWaiting = !_waiting.empty() && !_waiting.front().bLater;
    return !bWaiting && _refusedFilter.empty()
        && std::ranges::all_of(_unconfirmed, [](const auto& entry) { return entry.second.bLater; });
}

} // namespace ACS::VDA5050
