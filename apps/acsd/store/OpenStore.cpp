#include "store/OpenStore.hpp"

#include "standby/LeaderStore.hpp"
#include "store/StoreSummary.hpp"
#include <acs/plan_postgres/PostgresPlanStore.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <cassert>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// The pause is stored: it outlasts a restart until the operator resumes the TSC.
template <typename TStore>
Core::Result<Planning::StoredState> Load(TStore& store, const StoreConfig& config)
{
    return store.Load().and_then([&](Planning::StoredState state) -> Core::Result<Planning::StoredState> {
        if (!store.GetOrigin().bNew || !config.bNewStorePaused)
        {
            return state;
        }
        state.tscState = Planning::ETscState::Paused;
        return store.Append({{Planning::TscChanged{state.tscState}}}).map([&state] { return std::move(state); });
    });
}

} // namespace

Core::Result<OpenedStore> OpenDirectoryStore(const StoreConfig& config)
{
    return Planning::SqlitePlanStore::Open(config.directory)
        .and_then([&config](std::unique_ptr<Planning::SqlitePlanStore> store) {
            return Load(*store, config).map([&store](Planning::StoredState state) {
                std::string summary = MakeStoreSummary(store->GetOrigin(), state);
                return OpenedStore{std::move(store), std::move(state), std::move(summary), {}};
            });
        });
}

Core::Result<OpenedStore> OpenSharedStore(const StoreConfig& config, std::uint64_t epoch, LeaseGuard& guard)
{
    assert(config.postgres.has_value());
    Planning::PostgresOptions options = *config.postgres;
    options.timeout = config.lease; // a process that waits for longer does not lead any more
    options.shouldStop = [&guard] {
        return !guard.IsHeld();
    };
    return Planning::PostgresPlanStore::Open(std::move(options), epoch)
        .and_then([&config, &guard](std::unique_ptr<Planning::PostgresPlanStore> store) {
            return Load(*store, config).map([&store, &guard](Planning::StoredState state) {
                std::string summary = MakeStoreSummary(store->GetOrigin(), state);
                std::string identity = store->GetIdentity();
                return OpenedStore{
                    std::make_unique<LeaderStore>(std::move(store), guard),
                    std::move(state),
                    std::move(summary),
                    std::move(identity)};
            });
        });
}

} // namespace ACS::Acsd
