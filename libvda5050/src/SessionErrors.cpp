#include "SessionErrors.hpp"

#include "OrderErrors.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// Errors about orders and instant actions live until an order is taken; a peer that never gets one right must not fill
/// the state.
constexpr std::size_t MAXIMUM_SESSION_ERRORS = 16;

bool IsSameReport(const VehicleError& left, const VehicleError& right)
{
    const auto isSameReference = [&right](const ErrorReference& reference) {
        const std::string* other = FindReferenceOrNull(right, reference.referenceKey);
        return reference.referenceKey == ReferenceKeys::HEADER_ID
            || (other != nullptr && *other == reference.referenceValue);
    };
    return left.errorType == right.errorType && left.errorDescription == right.errorDescription
        && std::ranges::all_of(left.errorReferences, isSameReference);
}

/// Of an error about a message.
SessionErrors::ELifetime GetLifetime(ETopic topic)
{
    return topic == ETopic::Order ? SessionErrors::ELifetime::UntilOrder : SessionErrors::ELifetime::UntilInstantAction;
}

VehicleError MakeError(std::string_view errorType, std::string description, ETopic topic)
{
    VehicleError error;
    error.errorType = errorType;
    error.errorDescription = std::move(description);
    AddReference(error, ReferenceKeys::TOPIC, GetTopicName(topic));
    return error;
}

} // namespace

void SessionErrors::Add(VehicleError error, ELifetime lifetime)
{
    error.errorDescription.resize(CutForeignText(error.errorDescription).size());
    std::erase_if(_errors, [&error](const SessionError& known) { return IsSameReport(error, known.error); });
    if (_errors.size() >= MAXIMUM_SESSION_ERRORS)
    {
        const auto warning = std::ranges::find_if(_errors, [](const SessionError& known) {
            return known.error.errorLevel == EErrorLevel::Warning;
        });
        _errors.erase(warning != _errors.end() ? warning : _errors.begin());
    }
    _errors.push_back(SessionError{std::move(error), lifetime, _nextNumber++, false, false});
}

void SessionErrors::AddPayloadError(ETopic topic, std::string description, const MessageIdentity* identityOrNull)
{
    VehicleError error = MakeError(ErrorTypes::VALIDATION_ERROR, std::move(description), topic);
    // What could not be read is not made up: a master would take it for the refusal of another message.
    if (identityOrNull != nullptr && identityOrNull->bHeaderIDGiven)
    {
        AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(identityOrNull->header.headerID));
    }
    if (identityOrNull != nullptr && topic == ETopic::Order && !identityOrNull->orderID.empty())
    {
        AddReference(error, ReferenceKeys::ORDER_ID, identityOrNull->orderID);
    }
    if (identityOrNull != nullptr && topic == ETopic::Order && identityOrNull->orderUpdateID.has_value())
    {
        AddReference(error, ReferenceKeys::ORDER_UPDATE_ID, std::to_string(*identityOrNull->orderUpdateID));
    }
    Add(std::move(error), GetLifetime(topic));
}

void SessionErrors::AddNamelessAction(const Header& header)
{
    VehicleError error =
        MakeError(ErrorTypes::VALIDATION_ERROR, "an instant action has no actionId", ETopic::InstantActions);
    AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(header.headerID));
    Add(std::move(error), ELifetime::UntilInstantAction);
}

void SessionErrors::AddInstantActionError(
    const Action& action,
    std::optional<std::uint32_t> headerIDOrNull,
    std::string_view errorType,
    const ActionFault& fault)
{
    VehicleError error = MakeError(errorType, fault.rule, ETopic::InstantActions);
    if (headerIDOrNull.has_value())
    {
        AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(*headerIDOrNull));
    }
    AddReference(error, ReferenceKeys::ACTION_ID, action.actionID);
    if (!fault.field.empty())
    {
        AddReference(error, ReferenceKeys::PARAMETER, fault.field);
    }
    Add(std::move(error),
        errorType == ErrorTypes::NO_ORDER_TO_CANCEL ? ELifetime::UntilOrder : ELifetime::UntilInstantAction);
}

void SessionErrors::AddOrderActionError(const ReportedAction& failed, EErrorLevel level)
{
    // No orderId: some masters take every error with one for the refusal of the order; and others one without a topic.
    VehicleError error = MakeError(
        ErrorTypes::ACTION_ERROR,
        failed.action.actionType + " failed: " + failed.machine.GetState().resultDescription,
        ETopic::Order);
    error.errorLevel = level;
    AddReference(error, ReferenceKeys::ACTION_ID, failed.action.actionID);
    AddReference(
        error,
        failed.scope == EActionScope::Node ? ReferenceKeys::NODE_ID : ReferenceKeys::EDGE_ID,
        failed.elementID);
    Add(std::move(error), ELifetime::UntilOrder);
}

void SessionErrors::AddUnlistedParameters(const Action& action, ETopic topic, const std::vector<std::string>& keys)
{
    VehicleError error = MakeError(
        ErrorTypes::UNLISTED_PARAMETER,
        "parameters of " + action.actionType + " that the factsheet does not list have no effect",
        topic);
    AddReference(error, ReferenceKeys::ACTION_ID, action.actionID);
    for (const std::string& key : keys)
    {
        AddReference(error, ReferenceKeys::PARAMETER, key);
    }
    Add(std::move(error), GetLifetime(topic));
}

void SessionErrors::End(ELifetime lifetime, std::uint64_t mark)
{
    EndIf([lifetime, mark](const SessionError& known) { return known.lifetime == lifetime && known.number < mark; });
}

void SessionErrors::EndAll()
{
    EndIf([](const SessionError& /*known*/) { return true; });
}

void SessionErrors::EndWarnings()
{
    EndIf([](const SessionError& known) { return known.error.errorLevel == EErrorLevel::Warning; });
}

bool SessionErrors::ShouldShowEnds()
{
    const std::size_t ended = std::erase_if(_errors, [](const SessionError& known) { return known.bEnded; });
    for (SessionError& known : _errors)
    {
        known.bShown = true;
    }
    return ended > 0;
}

std::uint64_t SessionErrors::GetMark() const noexcept
{
    return _nextNumber;
}

void SessionErrors::AppendTo(std::vector<VehicleError>& errors) const
{
    std::ranges::transform(_errors, std::back_inserter(errors), &SessionError::error);
}

} // namespace ACS::VDA5050
