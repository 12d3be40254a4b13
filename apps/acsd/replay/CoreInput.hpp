#pragma once

#include "AcsdTimer.hpp"
#include <acs/core/Result.hpp>
#include <acs/plan/CommandReceipt.hpp>
#include <acs/plan/EngineInput.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/StoreLog.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <optional>
#include <string>
#include <variant>

namespace ACS::Acsd
{

/// AcsdCore::Restore
struct RestoreInput
{
    Planning::StoredState state;
};

/// AcsdCore::Start
struct StartInput
{
};

/// AcsdCore::Reload
struct ReloadInput
{
    std::string config; ///< A text of MakeRecordedConfig.
};

/// AcsdCore::OnMqttUp and OnMqttDown
struct MqttInput
{
    bool bUp = false;
};

/// AcsdCore::OnStored
struct StoredInput
{
    std::optional<Core::Error> errorOrNull; ///< nullopt: the batch is stored.
};

/// AcsdCore::OnStoreLost
struct StoreLostInput
{
    Core::Error error;
};

/// AcsdCore::Offer
struct OfferInput
{
    Planning::PlanCommand command;
    std::optional<Planning::CommandReceipt> receipt;
};

/// AcsdCore::OnLinksClosed
struct LinksClosedInput
{
};

/// AcsdCore::Stop
struct StopInput
{
};

/// AcsdCore::Close
struct CloseInput
{
};

/// One call of AcsdCore. RobotInput, AcsdTimer and StoreLog are the calls OnRobotEvent, OnTimer and OnStoreLog.
using CoreInput = std::variant<
    RestoreInput,
    StartInput,
    ReloadInput,
    Protocol::SessionEvent,
    Planning::RobotInput,
    AcsdTimer,
    MqttInput,
    StoredInput,
    StoreLostInput,
    Planning::StoreLog,
    OfferInput,
    LinksClosedInput,
    StopInput,
    CloseInput>;

} // namespace ACS::Acsd
