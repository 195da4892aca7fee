//! Operators of number types without repeated headers.

/// Operators of a number from functions of its values: `[attribute] [parameters] Number => Output`, then
/// `Trait::function(x, y) { .. }` for each. Without an output the operators give the number itself.
#[macro_export]
macro_rules! operators {
    ($inline:tt $parameters:tt $number:ty => $output:ty; $($trait:ident::$function:ident($x:ident $(, $y:ident)?) $body:block)+) => {
        $($crate::operators!(@one $inline $parameters [$number] [$output] $trait $function $x [$($y)?] $body);)+
    };
    ($inline:tt $parameters:tt $number:ty; $($rest:tt)+) => {
        $crate::operators!($inline $parameters $number => Self; $($rest)+);
    };
    (
        @one [$($inline:tt)+] [$($parameters:tt)*] [$number:ty] [$output:ty]
        $trait:ident $function:ident $x:ident [$($y:ident)?] $body:block
    ) => {
        // the formula of a product of duals or of discs has sums
        #[allow(clippy::suspicious_arithmetic_impl)]
        impl<$($parameters)*> std::ops::$trait for $number {
            type Output = $output;
            #[$($inline)+]
            fn $function(self $(, $y: Self)?) -> $output {
                let $x = self;
                $body
            }
        }
    };
}
