#include "robots/ArmInputTransfer.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>

namespace ACS::Acsd
{

ArmInputTransfer::ArmInputTransfer(std::vector<ArmInput> inputs, std::size_t retryLimit)
    : _inputs(std::move(inputs)),
      _retryLimit(retryLimit)
{
}

void ArmInputTransfer::Begin()
{
    _retries = 0;
    _current = 0;
}

const ArmInput& ArmInputTransfer::GetCurrent() const
{
    assert(_current < _inputs.size());
    return _inputs[_current];
}

bool ArmInputTransfer::TryNext()
{
    if (_current + 1 >= _inputs.size())
    {
        return false;
    }
    ++_current;
    return true;
}

void ArmInputTransfer::BeginReading()
{
    _difference.clear();
}

bool ArmInputTransfer::TryVerify(const std::vector<ArmRelayWords>& ranges)
{
    _difference.clear();
    for (const ArmInput& input : _inputs)
    {
        std::optional<std::int32_t> value;
        for (const ArmRelayWords& shown : ranges)
        {
            value = value.has_value() ? value : ReadRelayOrNull(input.relay, shown.range, shown.words);
        }
        if (!value.has_value() || !IsSameValue(input.relay, input.value, *value))
        {
            _difference = fmt::format(
                "relay {} was written as {} and reads {}",
                input.relay.name,
                input.value,
                value.has_value() ? fmt::format("{}", *value) : "nothing");
            return false;
        }
    }
    return true;
}

bool ArmInputTransfer::TryRetry()
{
    if (_retries >= _retryLimit)
    {
        return false;
    }
    ++_retries;
    _current = 0;
    return true;
}

const std::vector<ArmInput>& ArmInputTransfer::GetInputs() const noexcept
{
    return _inputs;
}

std::string ArmInputTransfer::DescribeDifference() const
{
    return _difference.empty() ? "the relays are not shown" : _difference;
}

} // namespace ACS::Acsd
