#include "MasterSession.Impl.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <utility>

namespace ACS::VDA5050
{

MasterSession::MasterSession(MasterOptions options)
    : _impl(std::make_unique<Impl>(std::move(options)))
{
}

MasterSession::MasterSession(MasterSession&&) noexcept = default;

MasterSession& MasterSession::operator=(MasterSession&&) noexcept = default;

MasterSession::~MasterSession() = default;

Core::Result<MasterSession> MasterSession::Create(MasterOptions options)
{
    if (!IsValidAddress(options.address))
    {
        const VehicleAddress& address = options.address;
        return Core::Fail(
            EVda5050Error::InvalidTopic,
            "address",
            "names that are allowed in a topic",
            Core::QuoteForError(address.interfaceName + "/" + address.manufacturer + "/" + address.serialNumber));
    }
    return MasterSession(std::move(options));
}

std::vector<MqttSubscription> MasterSession::GetSubscriptions() const
{
    return _impl->GetTopics().GetSubscriptions();
}

void MasterSession::OnLinkUp(Core::Now now, MasterActions& out)
{
    _impl->OnLinkUp(now, out);
}

void MasterSession::OnLinkDown(Core::Now now, MasterActions& out)
{
    _impl->OnLinkDown(now, out);
}

void MasterSession::OnMessage(const MqttMessage& message, Core::Now now, MasterActions& out)
{
    _impl->OnMessage(message.topic, message.payload, message.bRetained, now, out);
}

void MasterSession::OnMessage(std::string_view topic, std::string_view payload, Core::Now now, MasterActions& out)
{
    _impl->OnMessage(topic, payload, false, now, out);
}

void MasterSession::OnTimer(EMasterTimer timer, Core::Now now, MasterActions& out)
{
    _impl->OnTimer(timer, now, out);
}

Core::Result<void> MasterSession::SendOrder(OrderMessage order, Core::Now now, MasterActions& out)
{
    return _impl->SendOrder(std::move(order), now, out);
}

void MasterSession::SetHorizonOmitted(bool bOmitted) noexcept
{
    _impl->SetHorizonOmitted(bOmitted);
}

Core::Result<void> MasterSession::CheckOrder(OrderMessage order, Core::Now now) const
{
    return _impl->Prepare(order, now).map([](bool) {});
}

Core::Result<void> MasterSession::SendOrderUpdate(OrderMessage update, Core::Now now, MasterActions& out)
{
    return _impl->SendOrderUpdate(std::move(update), now, out);
}

Core::Result<void> MasterSession::ResumeOrder(OrderRecord record, Core::Now now, MasterActions& out)
{
    return _impl->ResumeOrder(std::move(record), now, out);
}

Core::Result<std::string> MasterSession::SendInstantAction(Action action, Core::Now now, MasterActions& out)
{
    return _impl->SendInstantAction(std::move(action), now, out);
}

bool MasterSession::IsOrderSent() const noexcept
{
    return _impl->IsOrderSent();
}

bool MasterSession::TryWithdrawInstantAction(std::string_view actionID)
{
    return _impl->TryWithdrawInstantAction(actionID);
}

Core::Result<void> MasterSession::Cancel(Core::Now now, MasterActions& out)
{
    return _impl->Cancel(now, out);
}

std::vector<ReservedElement> MasterSession::ListReserved() const
{
    return _impl->ListReserved();
}

EVehicleLink MasterSession::GetLink() const noexcept
{
    return _impl->GetVehicle().GetLink();
}

EOrderPhase MasterSession::GetOrderPhase() const noexcept
{
    return _impl->GetOrderPhase();
}

const std::string& MasterSession::GetOrderID() const noexcept
{
    return _impl->GetOrderID();
}

bool MasterSession::CanTakeOrder() const
{
    return _impl->CanTakeOrder();
}

bool MasterSession::IsReady() const
{
    return _impl->GetVehicle().IsReady();
}

const StateMessage* MasterSession::GetStateOrNull() const noexcept
{
    return _impl->GetVehicle().GetStateOrNull();
}

const FactsheetMessage* MasterSession::GetFactsheetOrNull() const noexcept
{
    return _impl->GetRules().GetFactsheetOrNull();
}

const MasterStatistics& MasterSession::GetStatistics() const noexcept
{
    return _impl->GetTopics().GetStatistics();
}

const MasterOptions& MasterSession::GetOptions() const noexcept
{
    return _impl->GetOptions();
}

} // namespace ACS::VDA5050
