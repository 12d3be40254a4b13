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

/// An action that a vehicle's state shows. Status and start change through ReportedActions alone, which counts them.
struct ReportedAction
{
    Action action;
    ActionMachine machine;
    EActionScope scope = EActionScope::Node;
    std::string elementID = {};   ///< Of its node or edge.
    std::uint32_t sequenceID = 0; ///< Of its node or edge.
    bool bStarted = false;        ///< The owner was told to.
    bool bCancelled = false;
    bool bShown = false; ///< Its end was in a state that was published.

    [[nodiscard]] bool IsInstant() const noexcept;
    [[nodiscard]] bool IsEnded() const noexcept;
    /// Of an order, begun and not ended.
    [[nodiscard]] bool IsRunningInOrder() const noexcept;
};

/// What a vehicle keeps of actions, in the order of its report: found by their id, and counted by what decides whether
/// the next one may begin and the vehicle may drive, so that neither takes longer where there are thousands.
class ReportedActions
{
public:
    using Iterator = std::list<ReportedAction>::iterator;
    using ConstIterator = std::list<ReportedAction>::const_iterator;

private:
    /// See the functions that tell them.
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
    std::unordered_map<std::string_view, Iterator> _index; ///< The keys lie in _held, whose elements never move.
    Counts _counts{};

    [[nodiscard]] static Counts Measure(const ReportedAction& held);
    void Count(const ReportedAction& held);
    void Discount(const ReportedAction& held);
    [[nodiscard]] std::size_t Get(ECount count) const noexcept;

public:
    ReportedActions() = default;
    ReportedActions(const ReportedActions&) = delete;
    ReportedActions& operator=(const ReportedActions&) = delete;
    ReportedActions(ReportedActions&&) = default;
    ReportedActions& operator=(ReportedActions&&) = default;
    ~ReportedActions() = default;

    /// At the end; no action with this id is held. The element stays where it is until it is erased.
    ReportedAction& Add(ReportedAction held);
    [[nodiscard]] ReportedAction* FindOrNull(std::string_view actionID);
    /// As ActionMachine::TrySet; a long description is cut.
    bool TrySetStatus(ReportedAction& held, EActionStatus status, std::string resultDescription = {});
    void MarkStarted(ReportedAction& held);
    Iterator Erase(Iterator position);

    /// Erases all that the predicate says yes to.
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
    /// What the instant ones take in a state, at most, without their results.
    [[nodiscard]] std::size_t GetInstantBytes() const noexcept;
    /// Of an order and not ended, begun or not.
    [[nodiscard]] std::size_t CountOpen() const noexcept;
    // Of an order, begun and not ended: all, those beside which nobody drives, those beside which nothing begins.
    [[nodiscard]] std::size_t CountRunning() const noexcept;
    [[nodiscard]] std::size_t CountRunningBlocking() const noexcept;
    [[nodiscard]] std::size_t CountRunningHard() const noexcept;

    // Range-based for.
    [[nodiscard]] Iterator begin() noexcept;            // NOLINT(readability-identifier-naming)
    [[nodiscard]] Iterator end() noexcept;              // NOLINT(readability-identifier-naming)
    [[nodiscard]] ConstIterator begin() const noexcept; // NOLINT(readability-identifier-naming)
    [[nodiscard]] ConstIterator end() const noexcept;   // NOLINT(readability-identifier-naming)
};

} // namespace ACS::VDA5050
