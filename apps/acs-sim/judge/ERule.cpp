#include "judge/ERule.hpp"

#include <array>

namespace ACS::AcsSim
{

namespace
{

struct RuleText
{
    std::string_view name;
    std::string_view section;
    std::string_view meaning;
};

/// By ERule.
constexpr std::array<RuleText, RULE_COUNT> TEXTS{{
    {"registration", "6.2", "The first Registration is answered with Success in time."},
    {"before-registration", "5", "The MCS sends no request before it has accepted the Registration."},
    {"reconnect", "6.2", "After a lost connection the Registration is answered with Success in time."},
    {"json", "6", "Each message is one JSON object."},
    {"envelope",
     "6.1",
     "A request has command, transactionId, timestamp and payload; an Ack has a result instead of the payload."},
    {"transaction-id", "6.1", "The transactionId of a request is a UUID that no other request has."},
    {"timestamp", "6.1", "The timestamp is a local time in ISO 8601."},
    {"command", "5.1", "The MCS sends commands of section 5.1 and Acks only."},
    {"request-payload", "6.5-6.11", "The payload of a control or query is as specified."},
    {"ack", "6.1", "Each request of the ACS is answered with an Ack in time."},
    {"ack-once", "6.1", "A request is answered once each time that it is sent."},
    {"ack-transaction", "6.1", "An Ack has the transactionId of a request."},
    {"ack-command", "6.1", "The command of an Ack is that of its request, followed by Ack."},
    {"ack-result", "6.1", "The result of an Ack is Success or Fail."},
    {"report-accepted", "6.1", "A valid report about a plan of the MCS, and a valid state, are answered with Success."},
    {"report-repeated", "6.1", "A repeated report is answered with the same result as before."},
    {"report-reconnect", "6.1", "A report that is sent again after a reconnect is answered with Success."},
    {"undefined-payload", "6.1", "A request with an undefined payload is answered with Fail."},
    {"unknown-command", "6.1", "A request with an unknown command is answered with Fail."},
    {"malformed-text", "6.1", "After a text that is not JSON, further requests are answered on the same connection."},
    {"position", "6.19", "RobotPositionUpdate is not answered."},
    {"plan-payload", "6.3, 6.4", "The payload of an ExecutionPlan is as specified."},
    {"plan-location", "3.1", "Locations of a plan follow the notation, with numbers of two digits."},
    {"plan-steps", "6.3, 6.4", "The stepNo begin at 1 and are unique; so are the jobIds of a plan."},
    {"plan-action", "6.3, 6.4", "Actions are those of the tables, with from and to of their kind."},
    {"plan-carriers", "6.4", "MemoryPickAndPlace has no carrierIds."},
    {"plan-id", "6.3", "A planId is used for one plan; a plan is sent again only if the ACS has refused it."},
    {"plan-withheld", "6.21", "No plan is sent while isConnected is false."},
    {"control", "6.5-6.8", "Controls name a plan that the ACS has accepted."},
}};

const RuleText& GetTexts(ERule rule)
{
    return TEXTS.at(static_cast<std::size_t>(rule));
}

} // namespace

std::string_view GetName(ERule rule)
{
    return GetTexts(rule).name;
}

std::string_view GetSection(ERule rule)
{
    return GetTexts(rule).section;
}

std::string_view GetMeaning(ERule rule)
{
    return GetTexts(rule).meaning;
}

} // namespace ACS::AcsSim
