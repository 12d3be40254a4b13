#pragma once

#include <acs/plan/EJobState.hpp>
#include <acs/plan/EPlanState.hpp>
#include <acs/plan/EStepState.hpp>
#include <acs/plan/ETscState.hpp>

#include <algorithm>
#include <array>
#include <span>

namespace ACS::Planning
{

/// An allowed change of a state.
template <typename TState>
struct Transition
{
    TState from; ///< The state before.
    TState to;   ///< The state after.
};

/// The transitions that sections 6.5 to 6.8 and 6.12 of MCS-ACS allow, and those of a plan that another robot takes over. The
/// engine makes no other transition.
inline constexpr std::array PLAN_TRANSITIONS{
    Transition<EPlanState>{EPlanState::Pending, EPlanState::InProgress},
    Transition<EPlanState>{EPlanState::Pending, EPlanState::Paused},
    Transition<EPlanState>{EPlanState::Pending, EPlanState::Cancelled},
    Transition<EPlanState>{EPlanState::Pending, EPlanState::Aborted},
    Transition<EPlanState>{EPlanState::InProgress, EPlanState::Completed},
    Transition<EPlanState>{EPlanState::InProgress, EPlanState::Failed},
    Transition<EPlanState>{EPlanState::InProgress, EPlanState::Cancelled},
    Transition<EPlanState>{EPlanState::InProgress, EPlanState::Aborted},
    Transition<EPlanState>{EPlanState::InProgress, EPlanState::Paused},
    Transition<EPlanState>{EPlanState::Paused, EPlanState::InProgress},
    Transition<EPlanState>{EPlanState::Paused, EPlanState::Pending},
    Transition<EPlanState>{EPlanState::Paused, EPlanState::Aborted},
};

/// Those of a step.
inline constexpr std::array STEP_TRANSITIONS{
    Transition<EStepState>{EStepState::Pending, EStepState::Dispatched},
    Transition<EStepState>{EStepState::Pending, EStepState::Skipped},
    Transition<EStepState>{EStepState::Dispatched, EStepState::InProgress},
    Transition<EStepState>{EStepState::Dispatched, EStepState::Failed},
    Transition<EStepState>{EStepState::Dispatched, EStepState::Dispatched}, // to another robot, before the first job
    Transition<EStepState>{EStepState::InProgress, EStepState::Dispatched}, // likewise
    Transition<EStepState>{EStepState::InProgress, EStepState::Completed},
    Transition<EStepState>{EStepState::InProgress, EStepState::Failed},
    Transition<EStepState>{EStepState::InProgress, EStepState::Skipped}, // SkipStep of a step with an unresolved job
};

/// Those of a job.
inline constexpr std::array JOB_TRANSITIONS{
    Transition<EJobState>{EJobState::Pending, EJobState::Instructed},
    Transition<EJobState>{EJobState::Instructed, EJobState::InProgress},
    Transition<EJobState>{EJobState::Instructed, EJobState::Failed},
    Transition<EJobState>{EJobState::InProgress, EJobState::Completed},
    Transition<EJobState>{EJobState::InProgress, EJobState::Failed},
};

/// Those of the TSC.
inline constexpr std::array TSC_TRANSITIONS{
    Transition<ETscState>{ETscState::Auto, ETscState::Pausing},
    Transition<ETscState>{ETscState::Pausing, ETscState::Paused},
    Transition<ETscState>{ETscState::Pausing, ETscState::Auto},
    Transition<ETscState>{ETscState::Paused, ETscState::Auto},
};

/// Whether one of the transitions leads from the first state to the second.
template <typename TState>
[[nodiscard]] constexpr bool ContainsTransition(
    std::span<const Transition<TState>> transitions,
    TState from,
    TState to) noexcept
{
    return std::ranges::any_of(transitions, [from, to](const Transition<TState>& transition) {
        return transition.from == from && transition.to == to;
    });
}

/// Whether PLAN_TRANSITIONS allows the change. No state changes to itself.
[[nodiscard]] constexpr bool CanChange(EPlanState from, EPlanState to) noexcept
{
    return ContainsTransition<EPlanState>(PLAN_TRANSITIONS, from, to);
}

/// Whether STEP_TRANSITIONS allows the change.
[[nodiscard]] constexpr bool CanChange(EStepState from, EStepState to) noexcept
{
    return ContainsTransition<EStepState>(STEP_TRANSITIONS, from, to);
}

/// Whether JOB_TRANSITIONS allows the change.
[[nodiscard]] constexpr bool CanChange(EJobState from, EJobState to) noexcept
{
    return ContainsTransition<EJobState>(JOB_TRANSITIONS, from, to);
}

/// Whether TSC_TRANSITIONS allows the change.
[[nodiscard]] constexpr bool CanChange(ETscState from, ETscState to) noexcept
{
    return ContainsTransition<ETscState>(TSC_TRANSITIONS, from, to);
}

/// Whether the state has no further transition; a plan in such a state is not reported again.
[[nodiscard]] constexpr bool IsFinal(EPlanState state) noexcept
{
    return std::ranges::none_of(PLAN_TRANSITIONS, [state](const Transition<EPlanState>& transition) {
        return transition.from == state;
    });
}

/// Whether the state has no further transition.
[[nodiscard]] constexpr bool IsFinal(EStepState state) noexcept
{
    return std::ranges::none_of(STEP_TRANSITIONS, [state](const Transition<EStepState>& transition) {
        return transition.from == state;
    });
}

/// Whether the state has no further transition.
[[nodiscard]] constexpr bool IsFinal(EJobState state) noexcept
{
    return std::ranges::none_of(JOB_TRANSITIONS, [state](const Transition<EJobState>& transition) {
        return transition.from == state;
    });
}

} // namespace ACS::Planning
