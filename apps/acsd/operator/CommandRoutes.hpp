#pragma once

#include "common/http/HttpRoutes.hpp"
#include <acs/plan/CommandReceipt.hpp>
#include <acs/plan/EngineInput.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <functional>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// The functions of acsd that the routes of commands call.
struct CommandAccess
{
    /// Passes a command of the operator to the engine. The receipt is stored with it.
    std::function<
        Planning::EInputAdmission(Planning::PlanCommand command, std::optional<Planning::CommandReceipt> receiptOrNull)>
        submit;
    /// The receipt of the request that is being answered; nullopt if it has no Idempotency-Key.
    std::function<std::optional<Planning::CommandReceipt>(const Apps::HttpResponse& answer)> makeReceiptOrNull;
    /// Why nothing can be stored at present, as part of a sentence.
    std::function<std::optional<std::string>()> getStoreFaultOrNull;
};

/// The commands of the operator API, each a POST with a JSON body (docs/reference/http.md#commands). 202: accepted; the command may
/// still wait for the store. 400: the body is invalid. 404: the robot, alarm, job or plan does not exist. 409: its state does not
/// allow the command. 503: acsd stops, too many commands wait for the store (with Retry-After), or the store fails and the
/// command would be lost in a crash. Commands that only stop work (maintenance on, pause of the TSC, a block) are accepted even then,
/// and the message states that they are not stored. The engine must outlive the routes.
void AddCommandRoutes(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, const CommandAccess& access);

} // namespace ACS::Acsd
