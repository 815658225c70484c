//! The memory that processes share, for iceoryx2: files in the instance's directory.
//!
//! iceoryx2's own storage for this is in `/dev/shm`, where others can make files too, and open one
//! of these before it is made private; and it maps files whose room nobody has taken yet. This one
//! keeps its files where no other user can go ([`super::directory`]) and takes their room first
//! ([`super::mapping`]). Names and the protocol between maker and opener are those of iceoryx2's
//! storage in files: an opener waits until the maker has set the version.
#![allow(
    unsafe_code,
    reason = "a type in memory that processes share is only known by the agreement between them"
)]

use super::mapping::{Mapping, MappingError};
use core::fmt;
use core::marker::PhantomData;
use core::mem::MaybeUninit;
use core::ptr::NonNull;
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use core::time::Duration;
use iceoryx2::prelude::{FileName, Path, SemanticString as _, ZeroCopySend};
use iceoryx2_bb_elementary_traits::testing::abandonable::Abandonable;
use iceoryx2_bb_memory::bump_allocator::BumpAllocator;
use iceoryx2_bb_posix::file::AccessMode;
use iceoryx2_cal::dynamic_storage::{
    DynamicStorage, DynamicStorageBuilder, DynamicStorageCreateError, DynamicStorageOpenError,
    DynamicStorageOpenOrCreateError, Initializer, file,
};
use iceoryx2_cal::named_concept::{
    NamedConcept, NamedConceptBuilder, NamedConceptConfiguration as _, NamedConceptDoesExistError,
    NamedConceptListError, NamedConceptMgmt, NamedConceptPathHintRemoveError,
    NamedConceptRemoveError,
};
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt as _;
use std::path::PathBuf;
use std::time::Instant;

/// What a storage is finished with: its layout is that of this version of iceoryx2.
const VERSION: u64 = u64::from_le_bytes(*b"iox0.10\n");
/// Between two looks whether a maker has finished.
const POLL: Duration = Duration::from_millis(1);

/// The beginning of a file; what the type keeps beside itself follows.
#[repr(C)]
struct Content<T> {
    /// 0 until the rest is finished.
    version: AtomicU64,
    value: MaybeUninit<T>,
}

/// What may be shared.
pub(super) trait Shared: fmt::Debug + Send + Sync + ZeroCopySend {}
impl<T: fmt::Debug + Send + Sync + ZeroCopySend> Shared for T {}

/// A value in a file, mapped.
pub(super) struct Storage<T: Shared> {
    name: FileName,
    path: PathBuf,
    mapping: Mapping,
    /// Whether the file goes with this.
    owns: AtomicBool,
    value: PhantomData<T>,
}

// SAFETY: the value is `Send` and `Sync`; the mapping is of no thread in particular.
unsafe impl<T: Shared> Send for Storage<T> {}
// SAFETY: as above; what is changed through a shared reference is atomic.
unsafe impl<T: Shared> Sync for Storage<T> {}

impl<T: Shared> fmt::Debug for Storage<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Storage").field(&self.path).finish()
    }
}

impl<T: Shared> Storage<T> {
    fn content(mapping: &Mapping) -> NonNull<Content<T>> {
        mapping.start().cast()
    }
}

impl<T: Shared> Drop for Storage<T> {
    fn drop(&mut self) {
        if self.owns.load(Ordering::Relaxed) {
            // SAFETY: the mapping is as long as a content, and iceoryx2 refers to it no more.
            let content = unsafe { Self::content(&self.mapping).as_mut() };
            // SAFETY: a storage exists only of a finished value, and nobody owns it twice.
            unsafe { content.value.assume_init_drop() };
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

impl<T: Shared> Abandonable for Storage<T> {
    unsafe fn abandon_in_place(this: NonNull<Self>) {
        // SAFETY: the caller gives a storage that is used no more.
        let this = unsafe { &mut *this.as_ptr() };
        *this.owns.get_mut() = false;
        // SAFETY: as above; without ownership this undoes the mapping and no more.
        unsafe { core::ptr::drop_in_place(this) };
    }
}

impl<T: Shared> NamedConcept for Storage<T> {
    fn name(&self) -> &FileName {
        &self.name
    }
}

/// Names, lists and removal are those of iceoryx2's storage in files.
impl<T: Shared> NamedConceptMgmt for Storage<T> {
    type Configuration = file::Configuration<T>;

    unsafe fn remove_cfg(
        name: &FileName,
        config: &Self::Configuration,
    ) -> Result<bool, NamedConceptRemoveError> {
        // SAFETY: what the caller promises is what this wants.
        unsafe { file::Storage::<T>::remove_cfg(name, config) }
    }

    fn does_exist_cfg(
        name: &FileName,
        config: &Self::Configuration,
    ) -> Result<bool, NamedConceptDoesExistError> {
        file::Storage::<T>::does_exist_cfg(name, config)
    }

    fn list_cfg(config: &Self::Configuration) -> Result<Vec<FileName>, NamedConceptListError> {
        file::Storage::<T>::list_cfg(config)
    }

    fn remove_path_hint(path: &Path) -> Result<(), NamedConceptPathHintRemoveError> {
        file::Storage::<T>::remove_path_hint(path)
    }
}

impl<T: Shared> DynamicStorage<T> for Storage<T> {
    type Builder<'builder> = Builder<'builder, T>;

    fn does_support_persistency() -> bool {
        true
    }

    fn has_ownership(&self) -> bool {
        self.owns.load(Ordering::Relaxed)
    }

    fn release_ownership(&self) {
        self.owns.store(false, Ordering::Relaxed);
    }

    fn acquire_ownership(&self) {
        self.owns.store(true, Ordering::Relaxed);
    }

    fn get(&self) -> &T {
        // SAFETY: the mapping is as long as a content, and lives as long as `self`.
        let content = unsafe { Self::content(&self.mapping).as_ref() };
        // SAFETY: a storage exists only of a finished value.
        unsafe { content.value.assume_init_ref() }
    }

    unsafe fn __internal_set_type_name_in_config(config: &mut Self::Configuration, name: &str) {
        // SAFETY: what the caller promises is what this wants.
        unsafe { file::Storage::<T>::__internal_set_type_name_in_config(config, name) };
    }
}

/// How a storage is made or opened.
pub(super) struct Builder<'builder, T: Shared> {
    name: FileName,
    config: file::Configuration<T>,
    /// Bytes behind the value.
    supplement: usize,
    owns: bool,
    patience: Duration,
    initializer: Initializer<'builder, T>,
}

impl<T: Shared> fmt::Debug for Builder<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Builder").field(&self.path()).finish()
    }
}

impl<T: Shared> Builder<'_, T> {
    fn path(&self) -> PathBuf {
        let path = self.config.path_for(&self.name);
        PathBuf::from(OsStr::from_bytes(path.as_bytes()))
    }

    fn storage(&self, path: PathBuf, mapping: Mapping, owns: bool) -> Storage<T> {
        Storage {
            name: self.name,
            path,
            mapping,
            owns: AtomicBool::new(owns),
            value: PhantomData,
        }
    }

    fn make(&mut self) -> Result<Storage<T>, DynamicStorageCreateError> {
        let path = self.path();
        let length = size_of::<Content<T>>() + self.supplement;
        let mapping = Mapping::make(&path, length).map_err(|error| match error {
            MappingError::Exists => DynamicStorageCreateError::AlreadyExists,
            _ => DynamicStorageCreateError::InternalError,
        })?;
        let content = Storage::<T>::content(&mapping).as_ptr();
        // SAFETY: the mapping is as long as the content and the supplement behind it.
        let behind = unsafe { mapping.start().add(size_of::<Content<T>>()) };
        let mut allocator = BumpAllocator::new(behind, mapping.length() - size_of::<Content<T>>());
        // SAFETY: zeros are a `MaybeUninit`, and nobody touches it before the version is set.
        let value = unsafe { &mut (*content).value };
        if !self.initializer.call(value, &mut allocator) {
            let _ = std::fs::remove_file(&path);
            return Err(DynamicStorageCreateError::InitializationFailed);
        }
        // SAFETY: zeros are an atomic number.
        let version = unsafe { &(*content).version };
        version.store(VERSION, Ordering::SeqCst);
        Ok(self.storage(path, mapping, self.owns))
    }

    fn open_it(&self, to_write: bool) -> Result<Storage<T>, DynamicStorageOpenError> {
        let (path, started) = (self.path(), Instant::now());
        loop {
            match Mapping::open(&path, size_of::<Content<T>>(), to_write) {
                Ok(mapping) => {
                    let content = Storage::<T>::content(&mapping).as_ptr();
                    // SAFETY: it is long enough, and any bits are an atomic number.
                    let version = unsafe { &(*content).version };
                    match version.load(Ordering::SeqCst) {
                        VERSION => return Ok(self.storage(path, mapping, false)),
                        0 => {}
                        _ => return Err(DynamicStorageOpenError::VersionMismatch),
                    }
                }
                Err(MappingError::Missing) => return Err(DynamicStorageOpenError::DoesNotExist),
                Err(MappingError::Empty) => {}
                Err(MappingError::Exists | MappingError::Failed) => {
                    return Err(DynamicStorageOpenError::InternalError);
                }
            }
            if started.elapsed() >= self.patience {
                return Err(DynamicStorageOpenError::InitializationNotYetFinalized);
            }
            std::thread::sleep(POLL);
        }
    }
}

impl<T: Shared> NamedConceptBuilder<Storage<T>> for Builder<'_, T> {
    fn new(name: &FileName) -> Self {
        Self {
            name: *name,
            config: file::Configuration::default(),
            supplement: 0,
            owns: true,
            patience: Duration::ZERO,
            initializer: Initializer::new(|_, _| false),
        }
    }

    fn config(mut self, config: &file::Configuration<T>) -> Self {
        self.config = config.clone();
        self
    }
}

impl<'builder, T: Shared> DynamicStorageBuilder<'builder, T, Storage<T>> for Builder<'builder, T> {
    fn has_ownership(mut self, value: bool) -> Self {
        self.owns = value;
        self
    }

    /// Nobody but the user gets into the directory.
    fn enable_global_access(self, _value: bool) -> Self {
        self
    }

    fn supplementary_size(mut self, value: usize) -> Self {
        self.supplement = value;
        self
    }

    fn timeout(mut self, value: Duration) -> Self {
        self.patience = value;
        self
    }

    fn initializer<F>(mut self, value: F) -> Self
    where
        F: FnMut(&mut MaybeUninit<T>, &mut BumpAllocator) -> bool + 'builder,
    {
        self.initializer = Initializer::new(value);
        self
    }

    fn create(mut self) -> Result<Storage<T>, DynamicStorageCreateError> {
        self.make()
    }

    fn open(self, access: AccessMode) -> Result<Storage<T>, DynamicStorageOpenError> {
        self.open_it(matches!(access, AccessMode::Write | AccessMode::ReadWrite))
    }

    fn open_or_create(mut self) -> Result<Storage<T>, DynamicStorageOpenOrCreateError> {
        loop {
            match self.open_it(true) {
                Err(DynamicStorageOpenError::DoesNotExist) => match self.make() {
                    Err(DynamicStorageCreateError::AlreadyExists) => {}
                    made => return Ok(made?),
                },
                opened => return Ok(opened?),
            }
        }
    }
}
