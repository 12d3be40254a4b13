#pragma once

#include "robots/ArmFact.hpp"
#include "robots/ArmInput.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The inputs of a job's program on their way to the controller. They are written one by one and read back. Where the
/// controller shows other values, all of them are written again, a limited number of times.
class ArmInputTransfer
{
    std::vector<ArmInput> _inputs;
    std::size_t _retryLimit = 0;
    std::size_t _retries = 0;
    std::size_t _current = 0;
    std::string _difference; ///< Of the latest sample; empty: none has come.

public:
    /// Without inputs.
    ArmInputTransfer() = default;
    ArmInputTransfer(std::vector<ArmInput> inputs, std::size_t retryLimit);

    /// From the first input, with all retries left.
    void Begin();
    /// The one to be written. Only where there are inputs.
    [[nodiscard]] const ArmInput& GetCurrent() const;
    /// The current one was written. Returns false after the last.
    [[nodiscard]] bool TryNext();
    /// No sample has come yet.
    void BeginReading();
    /// Returns whether the sample shows every input as it was written.
    [[nodiscard]] bool TryVerify(const std::vector<ArmRelayWords>& ranges);
    /// No sample did: from the first input again. Returns false when no retry is left.
    [[nodiscard]] bool TryRetry();

    [[nodiscard]] const std::vector<ArmInput>& GetInputs() const noexcept;
    /// What the latest sample showed, for a person.
    [[nodiscard]] std::string DescribeDifference() const;
};

} // namespace ACS::Acsd
