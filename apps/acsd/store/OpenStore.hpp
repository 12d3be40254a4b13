#pragma once

#include "config/StoreConfig.hpp"
#include "standby/LeaseGuard.hpp"
#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace ACS::Acsd
{

/// A store with its content.
struct OpenedStore
{
    std::unique_ptr<Planning::IPlanStore> store;
    Planning::StoredState state;
    std::string summary;  ///< Of the content, for the log.
    std::string identity; ///< The same for all processes that share the store; empty: it is not shared.
};

/// Opens the store of this machine. Fails with a sentence and its remedy.
[[nodiscard]] Core::Result<OpenedStore> OpenDirectoryStore(const StoreConfig& config);

/// Opens a shared store with the epoch of its lease. The guard outlives the store.
[[nodiscard]] Core::Result<OpenedStore> OpenSharedStore(
    const StoreConfig& config,
    std::uint64_t epoch,
    LeaseGuard& guard);

} // namespace ACS::Acsd
