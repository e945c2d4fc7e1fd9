//! An array of a pattern: its own, or a part of a saved file.

use bytemuck::Pod;
use core::fmt;
use core::ops::Deref;
use std::sync::Arc;
#[cfg(feature = "files")]
use {core::ops::Range, memmap2::Mmap};

/// Plain numbers to read as a slice. What is added to a part of a file, or to what others hold too, is added to a copy.
#[derive(Clone)]
pub(crate) enum Store<T> {
    Owned(Arc<Vec<T>>),
    /// These bytes of a file.
    #[cfg(feature = "files")]
    Mapped(Arc<Mmap>, Range<usize>),
}

impl<T: Pod> Store<T> {
    /// A part of a file; nothing if it does not lie within the file as whole, aligned elements.
    #[cfg(feature = "files")]
    pub(crate) fn mapped(file: &Arc<Mmap>, bytes: Range<usize>) -> Option<Self> {
        let part = file.get(bytes.clone())?;
        bytemuck::try_cast_slice::<u8, T>(part).ok()?;
        Some(Self::Mapped(file.clone(), bytes))
    }

    pub(crate) fn push(&mut self, element: T) {
        self.to_mut().push(element);
    }

    /// Of a part of a file, or of what others hold too, a copy.
    pub(super) fn to_mut(&mut self) -> &mut Vec<T> {
        #[cfg(feature = "files")]
        if let Self::Mapped(..) = self {
            *self = self.to_vec().into();
        }
        match self {
            Self::Owned(elements) => Arc::make_mut(elements),
            #[cfg(feature = "files")]
            Self::Mapped(..) => unreachable!("was copied"),
        }
    }
}

impl<T> Default for Store<T> {
    fn default() -> Self {
        Vec::new().into()
    }
}

impl<T> From<Vec<T>> for Store<T> {
    fn from(elements: Vec<T>) -> Self {
        Self::Owned(Arc::new(elements))
    }
}

impl<T> From<&Arc<Vec<T>>> for Store<T> {
    fn from(elements: &Arc<Vec<T>>) -> Self {
        Self::Owned(elements.clone())
    }
}

impl<T: Pod> Deref for Store<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        match self {
            Self::Owned(elements) => elements,
            #[cfg(feature = "files")]
            Self::Mapped(file, bytes) => file
                .get(bytes.clone())
                .and_then(|part| bytemuck::try_cast_slice(part).ok())
                .unwrap_or(&[]),
        }
    }
}

impl<T: Pod> Extend<T> for Store<T> {
    fn extend<I: IntoIterator<Item = T>>(&mut self, elements: I) {
        self.to_mut().extend(elements);
    }
}

impl<'a, T: Pod> Extend<&'a T> for Store<T> {
    fn extend<I: IntoIterator<Item = &'a T>>(&mut self, elements: I) {
        self.to_mut().extend(elements);
    }
}

impl<T: Pod + fmt::Debug> fmt::Debug for Store<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.deref().fmt(f)
    }
}
