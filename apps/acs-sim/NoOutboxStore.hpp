#pragma once

#include <acs/protocol/IOutboxStore.hpp>

#include <cstdint>

namespace ACS::AcsSim
{

/// The reports are lost with the program.
class NoOutboxStore final : public Protocol::IOutboxStore
{
public:
    [[nodiscard]] Core::Result<void> Append(const Protocol::DurableRequest& /*request*/) override
    {
        return {};
    }

    [[nodiscard]] Core::Result<void> Remove(std::uint64_t /*sequence*/) override
    {
        return {};
    }
};

} // namespace ACS::AcsSim
