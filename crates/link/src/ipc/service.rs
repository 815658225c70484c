//! The service type of an instance: that of iceoryx2 between processes, with its memory in files
//! that are the user's alone.

use super::storage::Storage;
use core::fmt::Debug;
use iceoryx2::prelude::ZeroCopySend;
use iceoryx2::service::Service;
use iceoryx2::service::internal::ServiceInternal;
use iceoryx2::unique_id_generator::unique_system_id::UniqueSystemId;
use iceoryx2_bb_elementary_traits::testing::abandonable::Abandonable;
use iceoryx2_cal::shm_allocator::bump_allocator::BumpAllocator;
use iceoryx2_cal::shm_allocator::pool_allocator::PoolAllocator;
use iceoryx2_cal::zero_copy_connection::common::details::{Connection, SharedManagementData};
use iceoryx2_cal::{
    arc_sync_policy, bag, event, hash, monitoring, reactor, resizable_shared_memory, serialize,
    shared_memory, static_storage,
};
use shared_memory::common::details::{AllocatorDetails, Memory};

/// A segment of shared memory with an allocator.
type Segment<A> = Memory<A, Storage<AllocatorDetails<A>>>;

/// See the module.
#[derive(Debug, Clone)]
pub(super) struct PrivateIpc;

impl Service for PrivateIpc {
    type ServiceNameHasher = hash::recommended::Recommended;
    type StaticStorage = static_storage::recommended::Ipc;
    type ConfigSerializer = serialize::recommended::Recommended;
    type PersistentDynamicStorage<T: Debug + Send + Sync + ZeroCopySend + 'static> = Storage<T>;
    type Bag = bag::recommended::Recommended;
    type DynamicStorage<T: Debug + Send + Sync + ZeroCopySend + 'static> = Storage<T>;
    type SharedMemory = Segment<PoolAllocator>;
    type ResizableSharedMemory =
        resizable_shared_memory::dynamic::DynamicMemory<PoolAllocator, Segment<PoolAllocator>>;
    type Connection = Connection<Storage<SharedManagementData>>;
    /// No service here has events: this one is iceoryx2's, which keeps memory in `/dev/shm`.
    type Event = event::recommended::Ipc;
    type Monitoring = monitoring::recommended::Ipc;
    type Reactor = reactor::recommended::Ipc;
    type ArcThreadSafetyPolicy<T: Send + Debug + Abandonable> =
        arc_sync_policy::single_threaded::SingleThreaded<T>;
    type BlackboardMgmt<T: Send + Sync + Debug + ZeroCopySend + 'static> = Storage<T>;
    type BlackboardPayload = Segment<BumpAllocator>;
    type UniqueId = UniqueSystemId;
}

impl ServiceInternal<Self> for PrivateIpc {}
