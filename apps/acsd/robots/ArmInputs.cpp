#include "robots/ArmInputs.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

namespace ACS::Acsd
{

tl::expected<std::vector<ArmInput>, std::string> MakeArmInputs(const JobMethods& methods, const Planning::StartJob& job)
{
    std::vector<ArmInput> inputs;
    const JobData data = methods.MakeData(job);
    const JobMethod* const methodOrNull = methods.FindMethodOrNull(job.action, data);
    if (methodOrNull == nullptr)
    {
        return inputs;
    }
    for (const ArmInputTemplate& input : methodOrNull->armInputs)
    {
        const std::int64_t value = input.value.Resolve(data);
        if (!CanHold(input.relay, value))
        {
            return tl::unexpected(
                fmt::format("{} cannot hold {}, it holds {}", input.relay.name, value, MakeRangeText(input.relay)));
        }
        inputs.push_back({input.relay, static_cast<std::int32_t>(value)});
    }
    return inputs;
}

} // namespace ACS::Acsd
