#pragma once

#include "plan/JobTimes.hpp"
#include "plan/PlanAdmission.hpp"
#include "plan/PlanBook.hpp"
#include "restart/RestartHold.hpp"
#include "restart/StartupBarrier.hpp"
#include "robot/Fleet.hpp"
#include "site/BlockBook.hpp"
#include "transaction/AlarmBook.hpp"
#include "transaction/CallRecord.hpp"
#include "transaction/EngineTransaction.hpp"
#include "transaction/OutboxRoom.hpp"
#include "transaction/StoreBacklog.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/plan/ReportOutbox.hpp>

#include <utility>

namespace ACS::Planning
{

/// Data that the parts of the engine share: configuration, records, and the transaction of the present call. Each part refers
/// only to what it uses.
struct EngineState
{
    EngineOptions options;
    SiteMap site;
    Core::IRandom& random;
    PlanAdmission admission{options, site};
    BlockBook blocks{site};
    PlanBook plans{options};
    JobTimes jobTimes;
    Fleet fleet{options};
    AlarmBook alarms{options.mcsCodes};
    ReportOutbox outbox;
    StoreBacklog backlog;
    StartupBarrier startup;
    RestartHold hold;
    CallRecord call;
    OutboxRoom room{options, plans, outbox};
    EngineTransaction transaction{random, plans, alarms, outbox, room};

    EngineState(EngineOptions engineOptions, SiteMap siteMap, Core::IRandom& randomSource)
        : options(std::move(engineOptions)),
          site(std::move(siteMap)),
          random(randomSource)
    {
    }

    EngineState(const EngineState&) = delete;
    EngineState& operator=(const EngineState&) = delete;
    EngineState(EngineState&&) = delete;
    EngineState& operator=(EngineState&&) = delete;
    ~EngineState() = default;
};

} // namespace ACS::Planning
