#pragma once

#include "IRuleControl.hpp"

namespace ACS::Testing
{

/// The rule that openTCS documents for its scheduler: a vehicle allocates the resources of its route step by step, in their order and
/// exclusively, and frees those that it has left. Nothing prevents a deadlock.
class OrderedControl final : public IRuleControl
{
    std::vector<std::optional<std::size_t>> _holders; ///< By node.

public:
    OrderedControl(const Floor& floor, std::size_t vehicles);

protected:
    [[nodiscard]] bool TryTakePlan(const Vehicle& vehicle, const Planning::Plan& plan) override;
    [[nodiscard]] std::size_t Grant(const Vehicle& vehicle) override;
    void OnPassed(const Vehicle& vehicle) override;
};

} // namespace ACS::Testing
