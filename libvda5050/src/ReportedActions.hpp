#pragma once

#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <list>
#include <string>
#include <string_view>
#include <unordered_map>

namespace ACS::VDA5050
{

/// An action in a vehicle's state. Only ReportedActions, which counts them, changes status and start.
struct ReportedAction
{
    Action action;
    ActionMachine machine;
    EActionScope scope = EActionScope::Node;
    std::string elementID = {};   ///< Of its node or edge.
    std::uint32_t sequenceID = 0; ///< Of its node or edge.
    bool bStarted = false;        ///< StartAction was sent to the owner.
    bool bCancelled = false;
    bool bShown = false;      ///< Its end was published in a state.
    bool bPauseAsked = false; ///< PauseAction was sent to the owner, who has not reported PAUSED since.
    bool bOvertaken = false;  ///< An instant action during which an order or update was accepted.

    [[nodiscard]] bool IsInstant() const noexcept;
    [[nodiscard]] bool IsEnded() const noexcept;
    /// An order action that was started and has not ended.
    [[nodiscard]] bool IsRunningInOrder() const noexcept;
};

/// The actions in a vehicle's state, in their order. Indexed by id, and counted by the properties that decide whether the
/// next action may start and the vehicle may drive: neither becomes slower with thousands of actions.
class ReportedActions
{
public:
    using Iterator = std::list<ReportedAction>::iterator;
    using ConstIterator = std::list<ReportedAction>::const_iterator;

private:
    /// See the functions below.
    enum class ECount : std::uint8_t
    {
        Open,
        Running,
        RunningBlocking,
        RunningHard,
        Instant,
        InstantBytes,
    };

    using Counts = std::array<std::size_t, 6>;

    std::list<ReportedAction> _held;
    std::unordered_map<std::string_view, Iterator> _index; ///< The keys point into _held, whose elements never move.
    Counts _counts{};

public:
    ReportedActions() = default;
    ReportedActions(const ReportedActions&) = delete;
    ReportedActions& operator=(const ReportedActions&) = delete;
    ReportedActions(ReportedActions&&) = default;
    ReportedActions& operator=(ReportedActions&&) = default;
    ~ReportedActions() = default;

    /// Appends an action with a new id. The reference is valid until the action is erased.
    ReportedAction& Add(ReportedAction held);
    [[nodiscard]] ReportedAction* FindOrNull(std::string_view actionID);
    /// Like ActionMachine::TrySet; a long description is truncated.
    bool TrySetStatus(ReportedAction& held, EActionStatus status, std::string resultDescription = {});
    void MarkStarted(ReportedAction& held);
    Iterator Erase(Iterator position);

    /// Erases all actions that match the predicate.
    template <typename TPredicate>
    void EraseIf(TPredicate predicate)
    {
        for (Iterator position = _held.begin(); position != _held.end();)
        {
            position = predicate(*position) ? Erase(position) : std::next(position);
        }
    }

    [[nodiscard]] std::size_t GetSize() const noexcept;
    [[nodiscard]] std::size_t CountInstant() const noexcept;
    /// Maximum size of the instant actions in a state, without their results.
    [[nodiscard]] std::size_t GetInstantBytes() const noexcept;
    /// Order actions that have not ended.
    [[nodiscard]] std::size_t CountOpen() const noexcept;
    // Order actions that run: all; those that block driving (SOFT, HARD); those that block other actions as well (HARD).
    [[nodiscard]] std::size_t CountRunning() const noexcept;
    [[nodiscard]] std::size_t CountRunningBlocking() const noexcept;
    [[nodiscard]] std::size_t CountRunningHard() const noexcept;

    // Range-based for.
    [[nodiscard]] Iterator begin() noexcept;            // NOLINT(readability-identifier-naming)
    [[nodiscard]] Iterator end() noexcept;              // NOLINT(readability-identifier-naming)
    [[nodiscard]] ConstIterator begin() const noexcept; // NOLINT(readability-identifier-naming)
    [[nodiscard]] ConstIterator end() const noexcept;   // NOLINT(readability-identifier-naming)

private:
    [[nodiscard]] static Counts Measure(const ReportedAction& held);
    void Count(const ReportedAction& held);
    void Discount(const ReportedAction& held);
    [[nodiscard]] std::size_t Get(ECount count) const noexcept;
};

} // namespace ACS::VDA5050
