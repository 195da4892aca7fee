//! Records that are views of library values.

/// Defines a record together with its source: each field has its value behind it.
///
/// The function below the fields takes the source and makes the record; its statements come before the values.
///
/// ```text
/// view! {
///     /// A dimension, with the evidence for its value.
///     pub struct DecisionRecord {
///         /// The value used.
///         pub value: usize = d.value,
///     }
///     impl From(d: &Decision) {}
/// }
/// ```
macro_rules! view {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident { $($(#[$about:meta])* pub $field:ident: $kind:ty = $value:expr,)+ }
        $($maker:tt)+
    ) => {
        $(#[$meta])*
        $vis struct $name { $($(#[$about])* pub $field: $kind,)+ }
        view!(@ $name ($($field = $value,)+) $($maker)+);
    };
    (@ $name:ident ($($field:ident = $value:expr,)+) impl From($given:ident: $kind:ty) { $($first:tt)* }) => {
        impl From<$kind> for $name {
            fn from($given: $kind) -> Self {
                $($first)*
                Self { $($field: $value,)+ }
            }
        }
    };
    (
        @ $name:ident ($($field:ident = $value:expr,)+)
        $(#[$about:meta])* $vis:vis fn $new:ident($($given:tt)*) { $($first:tt)* }
    ) => {
        impl $name {
            $(#[$about])*
            #[must_use]
            $vis fn $new($($given)*) -> Self {
                $($first)*
                Self { $($field: $value,)+ }
            }
        }
    };
    (
        @ $name:ident ($($field:ident = $value:expr,)+)
        $(#[$about:meta])* $vis:vis fn $new:ident($($given:tt)*) -> Option<Self> { $($first:tt)* }
    ) => {
        impl $name {
            $(#[$about])*
            #[must_use]
            $vis fn $new($($given)*) -> Option<Self> {
                $($first)*
                Some(Self { $($field: $value,)+ })
            }
        }
    };
}
