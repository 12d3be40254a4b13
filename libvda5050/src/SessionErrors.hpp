#pragma once

#include "ActionFault.hpp"
#include "ReportedActions.hpp"
#include <acs/vda5050/Header.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/Topic.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The errors in a vehicle's state about messages and actions. None ends before a state has shown it.
class SessionErrors
{
public:
    /// All errors end with the next accepted order; some earlier.
    enum class ELifetime : std::uint8_t
    {
        UntilOrder,
        UntilInstantAction, ///< Until an instant action of a later message is accepted.
        UntilMode,          ///< Until the operating mode allows orders.
    };

private:
    struct SessionError
    {
        VehicleError error;
        ELifetime lifetime = ELifetime::UntilOrder;
        std::uint64_t number = 0; ///< In the order of arrival.
        bool bShown = false;      ///< Was published in a state.
        bool bEnded = false;      ///< Ends when a state has shown it.
    };

    std::vector<SessionError> _errors;
    std::uint64_t _nextNumber = 0;

public:
    /// Replaces an error that reports the same.
    void Add(VehicleError error, ELifetime lifetime);
    /// A payload that was not accepted; the identity is what could be read of it.
    void AddPayloadError(ETopic topic, std::string description, const MessageIdentity* identityOrNull);
    void AddNamelessAction(const Header& header);
    void AddInstantActionError(
        const Action& action,
        std::optional<std::uint32_t> headerIDOrNull,
        std::string_view errorType,
        const ActionFault& fault);
    /// An action of the order has failed.
    void AddOrderActionError(const ReportedAction& failed, EErrorLevel level);
    void AddUnlistedParameters(const Action& action, ETopic topic, const std::vector<std::string>& keys);

    /// Ends those of the lifetime that were added before the mark. An error that no state has shown ends with the next state.
    void End(ELifetime lifetime, std::uint64_t mark);
    /// An order was accepted.
    void EndAll();
    /// An update was accepted of an order that an error holds: FATAL errors remain.
    void EndWarnings();
    /// A state was published. True: it has shown errors that have ended, and the next one has to show their end.
    [[nodiscard]] bool ShouldShowEnds();
    void AppendTo(std::vector<VehicleError>& errors) const;
    /// Errors that are added from now on come after the mark.
    [[nodiscard]] std::uint64_t GetMark() const noexcept;

private:
    template <typename TPredicate>
    void EndIf(TPredicate isMeant)
    {
        std::erase_if(_errors, [&isMeant](const SessionError& known) { return known.bShown && isMeant(known); });
        for (SessionError& known : _errors)
        {
            known.bEnded = known.bEnded || isMeant(known);
        }
    }
};

} // namespace ACS::VDA5050
