#include "MosquittoLink.Impl.hpp"

#include <exception>
#include <utility>

namespace ACS::VDA5050
{

MosquittoLink::MosquittoLink(
    const boost::asio::any_io_executor& executor,
    Core::IRandom& random,
    Core::Logger logger,
    MosquittoOptions options,
    IMqttLinkListener& listener)
    : _impl(std::make_shared<Impl>(executor, random, std::move(logger), std::move(options), listener))
{
}

MosquittoLink::~MosquittoLink()
{
    try
    {
        _impl->Abandon();
    }
    catch (const std::exception&)
    {
        // Asio's timers may throw; the connection goes with the last reference in any case.
    }
}

void MosquittoLink::Start()
{
    _impl->Start();
}

Core::Result<void> MosquittoLink::Publish(const MqttMessage& message)
{
    return _impl->Publish(message);
}

void MosquittoLink::Subscribe(const std::vector<MqttSubscription>& subscriptions)
{
    _impl->Subscribe(subscriptions);
}

void MosquittoLink::Unsubscribe(const std::string& topicFilter)
{
    _impl->Unsubscribe(topicFilter);
}

void MosquittoLink::SetWill(const MqttWill& will)
{
    _impl->SetWill(will);
}

bool MosquittoLink::IsConnected() const
{
    return _impl->IsConnected();
}

std::size_t MosquittoLink::GetBrokerIndex() const
{
    return _impl->GetBrokerIndex();
}

void MosquittoLink::StopAsync(
    const std::optional<MqttMessage>& lastMessageOrNull,
    std::chrono::milliseconds timeout,
    StopHandler handler)
{
    _impl->StopAsync(lastMessageOrNull, timeout, std::move(handler));
}

} // namespace ACS::VDA5050
