#include "drivers/MqttRouter.hpp"

#include <algorithm>
#include <cassert>
#include <system_error>
#include <utility>

namespace ACS::Acsd
{

class MqttRouter::Service final : public IMqttService
{
    MqttRouter& _router;
    const std::string _robotID;
    const std::string _topicPrefix;
    VDA5050::IMqttLinkListener* _listenerOrNull = nullptr;

public:
    Service(MqttRouter& router, std::string robotID, std::string topicPrefix)
        : _router(router),
          _robotID(std::move(robotID)),
          _topicPrefix(std::move(topicPrefix))
    {
    }

    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    ~Service() override
    {
        _router.Remove(*this);
    }

    [[nodiscard]] const std::string& GetRobotID() const noexcept
    {
        return _robotID;
    }

    [[nodiscard]] const std::string& GetTopicPrefix() const noexcept
    {
        return _topicPrefix;
    }

    [[nodiscard]] VDA5050::IMqttLinkListener* GetListenerOrNull() const noexcept
    {
        return _listenerOrNull;
    }

    [[nodiscard]] Core::Result<void> Publish(const VDA5050::MqttMessage& message) override
    {
        if (_router._dependencies.mayCommand && !_router._dependencies.mayCommand())
        {
            return Core::Fail(
                std::make_error_code(std::errc::not_connected),
                message.topic,
                "a process that leads",
                "a standby");
        }
        MessageTrace* const traceOrNull = _router._dependencies.traceOrNull;
        if (traceOrNull == nullptr)
        {
            return _router._linkOrNull->Publish(message);
        }
        const Core::Now now = traceOrNull->GetNow(); // before the vehicle can have the message
        Core::Result<void> published = _router._linkOrNull->Publish(message);
        if (published.has_value())
        {
            traceOrNull->Write(
                {"mqtt", ProtocolBeast::EWireDirection::Out, _robotID, message.topic, message.payload},
                now);
        }
        return published;
    }

    void Subscribe(const std::vector<VDA5050::MqttSubscription>& subscriptions) override
    {
        std::vector<VDA5050::MqttSubscription> own;
        for (const VDA5050::MqttSubscription& subscription : subscriptions)
        {
            if (IsOwn(subscription.topicFilter))
            {
                own.push_back(subscription);
                continue;
            }
            _router._dependencies.logger.Error(
                "the driver of a robot subscribes outside of the topics that it has declared; the subscription is not made",
                {{"robotId", _robotID}, {"topic", subscription.topicFilter}, {"declared", _topicPrefix}});
        }
        if (!own.empty())
        {
            _router._linkOrNull->Subscribe(own);
        }
    }

    void Unsubscribe(const std::string& topicFilter) override
    {
        if (IsOwn(topicFilter))
        {
            _router._linkOrNull->Unsubscribe(topicFilter);
        }
    }

    void SetListener(VDA5050::IMqttLinkListener* listenerOrNull) override
    {
        _listenerOrNull = listenerOrNull;
    }

private:
    [[nodiscard]] bool IsOwn(std::string_view topicFilter) const
    {
        return topicFilter.starts_with(_topicPrefix)
            && (topicFilter.size() == _topicPrefix.size() || topicFilter[_topicPrefix.size()] == '/');
    }
};

MqttRouter::MqttRouter(Dependencies dependencies)
    : _dependencies(std::move(dependencies))
{
}

MqttRouter::~MqttRouter()
{
    assert(_services.empty());
}

void MqttRouter::SetLink(VDA5050::IMqttLink& link)
{
    _linkOrNull = &link;
}

std::unique_ptr<IMqttService> MqttRouter::MakeService(const std::string& robotID, const std::string& topicPrefix)
{
    auto service = std::make_unique<Service>(*this, robotID, topicPrefix);
    const bool bNew = _servicesByPrefix.emplace(topicPrefix, service.get()).second;
    assert(bNew);
    static_cast<void>(bNew);
    _services.push_back(service.get());
    const auto levels = static_cast<std::size_t>(std::ranges::count(topicPrefix, '/')) + 1;
    _mostLevels = std::max(_mostLevels, levels);
    return service;
}

void MqttRouter::OnLinkUp()
{
    ReportLink(true);
    if (IsClosed())
    {
        return;
    }
    for (const Service* const service : _services)
    {
        if (VDA5050::IMqttLinkListener* const listenerOrNull = service->GetListenerOrNull())
        {
            listenerOrNull->OnLinkUp();
        }
    }
}

void MqttRouter::OnLinkDown(std::error_code reason)
{
    ReportLink(false);
    if (IsClosed())
    {
        return;
    }
    for (const Service* const service : _services)
    {
        if (VDA5050::IMqttLinkListener* const listenerOrNull = service->GetListenerOrNull())
        {
            listenerOrNull->OnLinkDown(reason);
        }
    }
}

void MqttRouter::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    if (IsClosed())
    {
        return;
    }
    const Service* const serviceOrNull = FindServiceOrNull(message.topic);
    if (_dependencies.traceOrNull != nullptr)
    {
        const auto robotID =
            serviceOrNull == nullptr ? std::string_view() : std::string_view(serviceOrNull->GetRobotID());
        _dependencies.traceOrNull->Write(
            {"mqtt", ProtocolBeast::EWireDirection::In, robotID, message.topic, message.payload});
    }
    if (serviceOrNull != nullptr && serviceOrNull->GetListenerOrNull() != nullptr)
    {
        serviceOrNull->GetListenerOrNull()->OnMqttMessage(message);
    }
}

void MqttRouter::Remove(const Service& service)
{
    std::erase(_services, &service);
    const auto found = _servicesByPrefix.find(service.GetTopicPrefix());
    if (found != _servicesByPrefix.end() && found->second == &service)
    {
        _servicesByPrefix.erase(found);
    }
}

bool MqttRouter::IsClosed() const
{
    return _dependencies.isClosed && _dependencies.isClosed();
}

void MqttRouter::ReportLink(bool bUp) const
{
    if (_dependencies.onLink)
    {
        _dependencies.onLink(bUp);
    }
}

/// Looks up the topic without its last levels, at most as many times as the longest prefix has levels.
MqttRouter::Service* MqttRouter::FindServiceOrNull(std::string_view topic) const
{
    Service* bestOrNull = nullptr;
    std::size_t start = 0; // of the next level
    for (std::size_t levels = 1; levels <= _mostLevels && start <= topic.size(); ++levels)
    {
        const std::size_t end = std::min(topic.find('/', start), topic.size());
        const auto found = _servicesByPrefix.find(topic.substr(0, end));
        if (found != _servicesByPrefix.end())
        {
            bestOrNull = found->second;
        }
        start = end + 1;
    }
    return bestOrNull;
}

} // namespace ACS::Acsd
